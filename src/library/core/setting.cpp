// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/setting.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace flagstone {
namespace {

/// Without an exponent if possible: "0.000001" and "1000000" instead of "1e-06" and "1e+06".
std::string number_text(double number) {
  std::ostringstream text;
  text << number;
  const double size = std::abs(number);
  if (text.str().find('e') == std::string::npos || size < 1e-9 || size > 1e9) return text.str();
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.begin(), digits.end(), number, std::chars_format::fixed);
  return {digits.begin(), end.ptr};
}

/// The range with its limits rounded to float, so that 1e-6f satisfies the limit 1e-6.
ValidRange rounded_to_float(ValidRange range) {
  range.low = static_cast<float>(range.low);
  range.high = static_cast<float>(range.high);
  return range;
}

/// Whether the value is in range. False for NaN.
bool is_allowed(double value, const ValidRange& allowed) {
  if (std::isinf(value)) return value > 0 && allowed.allow_infinity;
  const bool high_enough = allowed.exclusive_min ? value > allowed.low : value >= allowed.low;
  return high_enough && value <= allowed.high;
}

struct Check {
  std::string_view method;
  const Setting& setting;

  void operator()(const bool* /*value*/) const {}
  void operator()(const int* value) const {
    check_number(method, setting.key, *value, setting.allowed);
  }
  void operator()(const float* value) const { check_float(setting.key, *value); }
  void operator()(const std::vector<float>* values) const {
    check_number(method, "length of " + std::string(setting.key),
                 static_cast<double>(values->size()), {.low = 1, .high = 1000});
    check_each(*values);
  }
  void operator()(const std::array<float, 3>* values) const { check_each(*values); }
  void operator()(const Choice& choice) const {
    if (choice.index() < choice.names().size()) return;
    throw_out_of_range(method, setting.key, static_cast<double>(choice.index()),
                       "a value of the enumeration");
  }

  void check_each(std::span<const float> values) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      check_float(std::string(setting.key) + "[" + std::to_string(i) + "]", values[i]);
    }
  }

  void check_float(std::string_view key, float value) const {
    if (is_allowed(value, rounded_to_float(setting.allowed))) return;
    throw_out_of_range(method, key, value, to_string(setting.allowed));
  }
};

}  // namespace

std::string to_string(const ValidRange& allowed) {
  std::ostringstream text;
  if (allowed.exclusive_min) {
    text << "above " << number_text(allowed.low) << ", up to " << number_text(allowed.high);
  } else if (allowed.low == allowed.high) {
    text << number_text(allowed.low);
  } else {
    text << number_text(allowed.low) << " to " << number_text(allowed.high);
  }
  if (!allowed.unit.empty()) text << ' ' << allowed.unit;
  if (allowed.allow_infinity) text << ", or inf for no limit";
  if (!allowed.remark.empty()) text << ", " << allowed.remark;
  return text.str();
}

void throw_out_of_range(std::string_view method, std::string_view key, double value,
                        std::string_view allowed) {
  std::ostringstream message;
  message << method << ": " << key << " = " << value << " is out of range (expected " << allowed
          << ')';
  throw std::invalid_argument(message.str());
}

float to_float(double number) noexcept {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::isinf(number) ? number : std::clamp(number, -most, most));
}

void check_number(std::string_view method, std::string_view key, double value,
                  const ValidRange& allowed) {
  if (!is_allowed(value, allowed)) throw_out_of_range(method, key, value, to_string(allowed));
}

void check_settings(std::string_view method, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    std::visit(Check{method, setting}, setting.value);
  }
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Sets every setting of every method to values just below and just above its range, infinity and
// NaN. The settings come from the lists that the command line and TOML use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "flagstone/baselines.hpp"
#include "library/core/setting.hpp"

namespace flagstone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// The error message for the default settings of a method after `spoil` has changed setting number
/// `number`; empty if there is no error.
std::string error_of(std::string_view method, std::size_t number,
                     const std::function<void(Setting&)>& spoil) {
  MethodConfig config = default_config(method);
  std::vector<Setting> settings = config.settings();
  spoil(settings.at(number));
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// Numbers outside the valid range.
std::vector<double> numbers_beyond(const ValidRange& allowed) {
  const auto just_beyond = [](double bound, double side) {
    return bound + side * (std::abs(bound) * 0.01 + 0.001);
  };
  const double below = allowed.exclusive_min ? allowed.low : just_beyond(allowed.low, -1);
  std::vector<double> numbers = {below, just_beyond(allowed.high, 1),
                                 std::numeric_limits<double>::quiet_NaN(),
                                 -std::numeric_limits<double>::infinity()};
  if (!allowed.allow_infinity) numbers.push_back(std::numeric_limits<double>::infinity());
  return numbers;
}

/// Calls `body(method, number, setting)` for every setting of every method.
template <class Body>
void for_every_setting(const Body& body) {
  register_baselines();
  for (const std::string_view method : method_names()) {
    MethodConfig config = default_config(method);
    const std::vector<Setting> settings = config.settings();
    ASSERT_FALSE(settings.empty()) << method;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      SCOPED_TRACE(std::string(method) + ", " + std::string(settings[i].key));
      body(method, i, settings[i]);
    }
  }
}

TEST(EverySetting, RejectsANumberOutOfRangeWithItsNameAndRange) {
  std::size_t rejected = 0;
  for_every_setting([&](std::string_view method, std::size_t i, const Setting& setting) {
    const bool is_number = std::holds_alternative<float*>(setting.value);
    if (!is_number) return;
    for (const double number : numbers_beyond(setting.allowed)) {
      const std::string error = error_of(method, i, [&](Setting& spoilt) {
        *std::get<float*>(spoilt.value) = static_cast<float>(number);
      });
      EXPECT_THAT(error, AllOf(HasSubstr(std::string(setting.key) + " = "),
                               HasSubstr("expected " + to_string(setting.allowed))))
          << number;
      ++rejected;
    }
  });
  EXPECT_GT(rejected, 100U);
}

TEST(EverySetting, RejectsAnIntegerOutOfRange) {
  std::size_t rejected = 0;
  for_every_setting([&](std::string_view method, std::size_t i, const Setting& setting) {
    if (!std::holds_alternative<int*>(setting.value)) return;
    const std::array<int, 4> numbers = {
        static_cast<int>(setting.allowed.low) - 1, static_cast<int>(setting.allowed.high) + 1,
        std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
    for (const int number : numbers) {
      const std::string error =
          error_of(method, i, [&](Setting& spoilt) { *std::get<int*>(spoilt.value) = number; });
      EXPECT_THAT(error, AllOf(HasSubstr(std::string(setting.key) + " = "),
                               HasSubstr("expected " + to_string(setting.allowed))))
          << number;
      ++rejected;
    }
  });
  EXPECT_GT(rejected, 10U);
}

TEST(EverySetting, RejectsAListThatIsEmptyTooLongOrHasANumberOutOfRange) {
  std::size_t rejected = 0;
  for_every_setting([&](std::string_view method, std::size_t i, const Setting& setting) {
    if (!std::holds_alternative<std::vector<float>*>(setting.value)) return;
    const auto list_of = [](Setting& spoilt) -> std::vector<float>& {
      return *std::get<std::vector<float>*>(spoilt.value);
    };
    const auto length = HasSubstr("length of " + std::string(setting.key));
    EXPECT_THAT(error_of(method, i, [&](Setting& spoilt) { list_of(spoilt).clear(); }), length);
    EXPECT_THAT(error_of(method, i, [&](Setting& spoilt) { list_of(spoilt).resize(1001, 1); }),
                length);
    for (const double number : numbers_beyond(setting.allowed)) {
      const std::string error = error_of(
          method, i, [&](Setting& spoilt) { list_of(spoilt).back() = static_cast<float>(number); });
      EXPECT_THAT(error, HasSubstr(std::string(setting.key) + "[")) << number;
      ++rejected;
    }
  });
  EXPECT_GT(rejected, 0U);
}

}  // namespace
}  // namespace flagstone

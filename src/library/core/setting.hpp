// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace flagstone {

/// The values that a number can have.
struct ValidRange {
  double low = 0;
  double high = 0;
  std::string_view unit = {};    ///< "m", "degrees"; empty for none
  bool exclusive_min = false;    ///< `low` itself is not allowed
  bool allow_infinity = false;   ///< infinity is also allowed and means "no limit"
  std::string_view remark = {};  ///< appended to the range in texts
};

/// For example "0 to 100 m", or "above 0, up to 100 m, or inf for no limit".
std::string to_string(const ValidRange& allowed);

/// A setting whose value is one of a few names: an enumeration of std::uint8_t with the values 0,
/// 1, 2, ...
class Choice {
 public:
  template <class Enumeration>
    requires std::is_enum_v<Enumeration> &&
                 std::is_same_v<std::underlying_type_t<Enumeration>, std::uint8_t>
  Choice(Enumeration& value, std::span<const std::string_view> names) noexcept
      : value_(reinterpret_cast<unsigned char*>(&value)), names_(names) {}

  [[nodiscard]] std::span<const std::string_view> names() const noexcept { return names_; }
  [[nodiscard]] std::size_t index() const noexcept { return *value_; }
  /// `index` must be less than names().size().
  void choose(std::size_t index) const noexcept { *value_ = static_cast<unsigned char>(index); }

 private:
  unsigned char* value_;
  std::span<const std::string_view> names_;
};

/// One setting of a method: its name, its location in memory, its meaning and its range. Each
/// method has a list of these. Checks, TOML files and the command line use that list.
struct Setting {
  std::string_view key;  ///< dotted: "elevation.scale" is `scale` in the table `elevation`
  std::variant<float*, int*, bool*, std::vector<float>*, std::array<float, 3>*, Choice> value;
  std::string_view meaning;
  ValidRange
      allowed{};  ///< range of the number, or of each element; lists have 1 to 1,000 elements
};

/// Throws std::invalid_argument "METHOD: KEY = VALUE is out of range (expected RANGE)" for the
/// first value out of range.
void check_settings(std::string_view method, const std::vector<Setting>& settings);

/// Throws std::invalid_argument "METHOD: KEY = VALUE is out of range (expected ALLOWED)".
[[noreturn]] void throw_out_of_range(std::string_view method, std::string_view key, double value,
                                     std::string_view allowed);

/// The value of a setting that is a float. Finite numbers beyond the range of float are clamped, so
/// that only infinity means "no limit".
float to_float(double number) noexcept;

/// Throws the same std::invalid_argument if `value` is out of range.
void check_number(std::string_view method, std::string_view key, double value,
                  const ValidRange& allowed);

}  // namespace flagstone

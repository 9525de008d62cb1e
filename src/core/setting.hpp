// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flagstone {

/// The values a number may take.
struct Allowed {
  double low = 0;
  double high = 0;
  std::string_view unit = {};    ///< "m", "degrees"; empty for none
  bool without_low = false;      ///< `low` itself is not allowed
  bool or_infinity = false;      ///< infinity is allowed too and stands for "none"
  std::string_view remark = {};  ///< in parentheses after the range
};

/// "0 to 100 m", "above 0, up to 100 m, or inf for none".
std::string to_string(const Allowed& allowed);

/// One setting of a method: what it is called, where it is kept, what it means and may be. The
/// check of a configuration, the TOML it is written as and read from, and the command line all go
/// by a method's list of these.
struct Setting {
  std::string_view key;  ///< dotted: "elevation.scale" is `scale` in the table `elevation`
  std::variant<float*, int*, bool*, std::vector<float>*> value;
  std::string_view meaning;
  Allowed allowed{};  ///< of each element where the value is a list, of 1 to 1,000 elements
};

/// Throws std::invalid_argument "METHOD: KEY = VALUE is out of range; allowed: ..." for the first
/// value out of range.
void check_settings(std::string_view method, const std::vector<Setting>& settings);

/// Throws that std::invalid_argument.
[[noreturn]] void refuse_setting(std::string_view method, std::string_view key, double value,
                                 std::string_view allowed);

/// Throws that std::invalid_argument if `value` is not allowed.
void check_number(std::string_view method, std::string_view key, double value,
                  const Allowed& allowed);

}  // namespace flagstone

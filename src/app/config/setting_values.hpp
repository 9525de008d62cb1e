// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::config {

struct Entry;

/// A value that a user gives to a setting, wherever it was written: in TOML or in Python.
struct Value {
  /// A value that no setting can have, such as a date.
  struct Other {
    std::string type;
  };
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;

  std::variant<Other, bool, std::int64_t, double, std::string, List, Table> held;
  std::string place{};  ///< where it stands, "mine.toml: line 3, column 9: "; empty if unknown

  [[nodiscard]] const Table& table() const { return std::get<Table>(held); }
  /// The value of that key in this table; null if it has none.
  [[nodiscard]] const Value* find(std::string_view key) const;
};

struct Entry {
  std::string key;
  Value value;
};

/// Sets the settings that `table` names; the others stay. Keys are nested tables or dotted. Zones
/// are replaced as a whole; the table `mount` goes to `mount`; the key `sensor` sets nothing.
/// Ranges are not checked here. Throws std::invalid_argument, one line that begins with the value's
/// place, for a key that is no setting and for a value of the wrong type.
void apply(const Value& table, MethodConfig& config, MountSettings& mount);

/// Has the method all settings that `table` names, apart from `mount` and `sensor`?
bool has_settings_of(const Value& table, MethodConfig config);

}  // namespace flagstone::config

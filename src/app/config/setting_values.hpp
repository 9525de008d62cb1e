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

/// The value of a setting as the user wrote it, in TOML or in Python.
struct Value {
  /// A value of a type that no setting has, such as a date.
  struct Other {
    std::string type;
  };
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;

  std::variant<Other, bool, std::int64_t, double, std::string, List, Table> held;
  std::string place{};  ///< "mine.toml: line 3, column 9: "; empty if unknown

  [[nodiscard]] const Table& table() const { return std::get<Table>(held); }
  /// The value of a key of this table; null if the table does not have the key.
  [[nodiscard]] const Value* find(std::string_view key) const;
};

struct Entry {
  std::string key;
  Value value;
};

/// Sets the settings in `table` and leaves the others unchanged. Keys are dotted or in nested
/// tables. Zones are replaced as a whole. The table `mount` sets `mount`. The key `sensor` is
/// ignored. Ranges are not checked. Throws std::invalid_argument, one line that starts with the
/// position, for an unknown key or a value of the wrong type.
void apply(const Value& table, MethodConfig& config, MountSettings& mount);

/// True if the method has all settings in `table`, not counting `mount` and `sensor`.
bool has_settings_of(const Value& table, MethodConfig config);

}  // namespace flagstone::config

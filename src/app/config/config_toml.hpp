// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/config/setting_values.hpp"

namespace flagstone::config {

/// Every setting as commented TOML, which `apply_toml` reads back to the same configuration.
std::string to_toml(MethodConfig config);
/// The table `mount`, likewise.
std::string to_toml(MountSettings mount);

/// What a TOML text says, as a table. Throws std::invalid_argument for a syntax error: one line
/// that begins with `source`, the name of the file, and the place in it.
Value parse_toml(std::string_view text, std::string_view source);
/// The same for a file. Throws std::invalid_argument likewise if it cannot be read.
Value parse_toml_file(const std::string& file);

/// parse_toml() and apply().
void apply_toml(std::string_view text, std::string_view source, MethodConfig& config,
                MountSettings& mount);

/// What the key `sensor` of a table names: a known sensor or a file. Throws std::invalid_argument
/// if that is no text.
std::optional<std::string> sensor_named_in(const Value& table);

}  // namespace flagstone::config

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/config/setting_values.hpp"

namespace flagstone::config {

/// All settings as commented TOML. `apply_toml` reads it back to the same configuration.
std::string to_toml(MethodConfig config);
/// The table `mount` as commented TOML.
std::string to_toml(MountSettings mount);

/// Parses TOML into a table. Throws std::invalid_argument for a syntax error: one line that starts
/// with `source`, the name of the file, and the line and column.
Value parse_toml(std::string_view text, std::string_view source);
/// Parses a TOML file. Throws std::invalid_argument also if the file cannot be read.
Value parse_toml_file(const std::string& file);

/// parse_toml() and apply().
void apply_toml(std::string_view text, std::string_view source, MethodConfig& config,
                MountSettings& mount);

/// The value of the key `sensor`: a known sensor or a file. Throws std::invalid_argument if it is
/// not a string.
std::optional<std::string> sensor_named_in(const Value& table);

}  // namespace flagstone::config

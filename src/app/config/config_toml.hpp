// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::config {

/// Every setting as commented TOML, which `apply_toml` reads back to the same configuration.
std::string to_toml(MethodConfig config);
/// The table `mount`, likewise.
std::string to_toml(MountSettings mount);

/// Overwrites the settings that `text` names; the others stay. Zones are replaced as a whole.
/// Throws std::invalid_argument with one line that begins with `source`, the file's name, and the
/// place in it, unless that is empty, for a syntax error, a setting there is none of, or a value of
/// the wrong type. Ranges are not checked here. The key `sensor` is for sensor_named_in() and sets
/// nothing. The table `mount` is a setting like others where it is asked for.
void apply_toml(std::string_view text, std::string_view source, MethodConfig& config,
                MountSettings& mount);
void apply_toml(std::string_view text, std::string_view source, MethodConfig& config);
void apply_toml(std::string_view text, std::string_view source, PatchworkConfig& config);

/// What the key `sensor` at the top of `text` names: a known sensor or a file. Throws as apply_toml
/// does where that is no text.
std::optional<std::string> sensor_named_in(std::string_view text, std::string_view source);

/// Sets the sensor's height, metres, in the settings of methods that have one.
void set_sensor_height(float height, MethodConfig& config);

}  // namespace flagstone::config

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::config {

/// Overwrites the settings that a TOML file names. Throws std::invalid_argument with one line that
/// says what is wrong.
void apply_file(const std::string& file, MethodConfig& config, MountSettings& mount_settings);

/// What the key `sensor` at the top of a TOML file names: a known sensor, or the path of a file
/// from the folder of this one. None for an empty name. Throws likewise.
std::optional<std::string> sensor_named_in_file(const std::string& file);

}  // namespace flagstone::config

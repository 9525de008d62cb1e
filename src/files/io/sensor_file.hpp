// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "flagstone/sensor.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads a sensor from TOML with the keys of the struct Sensor, as in the files of sensors/. The
/// beams and the height are required:
///
///     beams = 16                 # evenly spaced from elevation_top to elevation_bottom, or
///     elevation_top = 15.0       # elevations = [...], degrees, highest first
///     elevation_bottom = -15.0
///     height = 0.6               # above the ground, metres
///
/// Defaults: name and title from the file name, azimuth_begin 0 and azimuth_end 360 degrees, one
/// firing per 0.2 degrees, min_range 0.5, max_range 100 and range_sigma 0.02 m. With `rosette`,
/// elevation_top and elevation_bottom are given without beams, and firings defaults to 24,000
/// points. bad_file with one line: source, line, column, key and expected value. Changes `out` only
/// on success.
Status parse_sensor(std::string_view text, std::string_view source, Sensor& out);

/// As parse_sensor(), from a file: not_found, unreadable, bad_file, out_of_memory.
Status read_sensor(const std::filesystem::path& path, Sensor& out);

/// Finds a known sensor by name or, if the argument ends in .toml, reads it from that file.
/// invalid_argument lists the known sensors.
Status find_sensor(const std::string& name_or_file, Sensor& out);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "flagstone/sensor.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads a sensor from TOML with the keys of the struct Sensor, as the files in folder sensors/
/// have them. Two must be there, the beams and the height:
///
///     beams = 16                 # evenly apart from elevation_top to elevation_bottom, or
///     elevation_top = 15.0       # elevations = [...], degrees, highest first
///     elevation_bottom = -15.0
///     height = 0.6               # above the ground, metres
///
/// What else is left out is as of many sensors: name and title those of the file, azimuth_begin 0
/// and azimuth_end 360 degrees, firings one in 0.2 degrees, min_range 0.5, max_range 100 and
/// range_sigma 0.02 m. With `rosette` elevation_top and elevation_bottom stand alone, and firings
/// are 24,000 points. Errors are one line with source, line, column, field and what is allowed:
/// bad_file. `out` is only changed on success.
Status parse_sensor(std::string_view text, std::string_view source, Sensor& out);

/// The same from a file: not_found, unreadable, bad_file, out_of_memory.
Status read_sensor(const std::filesystem::path& path, Sensor& out);

/// The known sensor of that name, or if the name ends in .toml, the one in that file.
/// invalid_argument names the sensors there are.
Status find_sensor(const std::string& name_or_file, Sensor& out);

}  // namespace flagstone::io

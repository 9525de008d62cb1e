// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::doctor {

/// The expected height is kept unless the ground says otherwise by more than this, metres, and a
/// quarter of what scans differ.
inline constexpr double least_height_difference = 0.05;

/// It has to be set right if it is wrong by so much more, metres: labels suffer.
inline constexpr double harmful_height_difference = 0.1;

/// A frame whose ground is higher than this below its origin, metres, is not the sensor's.
inline constexpr double highest_ground = -0.15;

/// If the ground is higher than this and no beams are seen, the origin may be an axle instead of
/// the sensor.
inline constexpr double ground_below_an_axle = -0.6;

/// The beams of an HDL-64E meet up to so far above the origin of its frame, metres: 0.2 in KITTI's
/// scans. Whether they do no scan shows, so that the expected height is kept within this.
inline constexpr double hdl_64e_lift = 0.35;

/// How far off the expected height may be for what the scans know, metres.
double height_doubt(const CommonOrientation& orientation);

/// The known sensors that could have made such scans, the likeliest first.
std::vector<const Sensor*> matching_sensors(const Summary& summary);

/// Settings for scans that show their ground, as `orientation`, the summary's, says. `sensors`:
/// those that match, the likeliest first.
Advice advise(const Summary& summary, const CommonOrientation& orientation,
              const Expected& expected, const std::vector<const Sensor*>& sensors);

/// The advice as settings that a configuration file may hold, commented.
std::string to_toml(const Advice& advice);

}  // namespace flagstone::doctor

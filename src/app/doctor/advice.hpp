// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::doctor {

/// The expected height is kept if the measured one differs by at most this, in metres, plus a
/// quarter of the difference between scans.
inline constexpr double least_height_difference = 0.05;

/// An error that exceeds this tolerance by more than this, in metres, harms labels: severity `fix`.
inline constexpr double harmful_height_difference = 0.1;

/// If the ground is higher than this relative to the origin, in metres, the origin is not the
/// sensor.
inline constexpr double highest_ground = -0.15;

/// If the ground is higher than this, in metres, and no beams are found, the origin may be an axle.
inline constexpr double ground_below_an_axle = -0.6;

/// The beams of an HDL-64E meet up to this far above the origin of its frame, in metres (0.2 in
/// KITTI). A scan does not show whether they do, so the expected height is kept within this limit.
inline constexpr double hdl_64e_lift = 0.35;

/// Tolerance of the sensor height, metres: smaller differences from the expected height are
/// ignored.
double height_doubt(const CommonOrientation& orientation);

/// The known sensors that could have recorded these scans, the most likely first.
std::vector<const Sensor*> matching_sensors(const Summary& summary);

/// Recommended settings for scans in which the ground was found. `orientation`: of the summary.
/// `sensors`: see matching_sensors().
Advice advise(const Summary& summary, const CommonOrientation& orientation,
              const Expected& expected, const std::vector<const Sensor*>& sensors);

/// The advice as a commented configuration file.
std::string to_toml(const Advice& advice);

}  // namespace flagstone::doctor

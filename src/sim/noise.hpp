// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/random.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::sim {

/// How a measurement differs from the truth. The sensor's own range accuracy stands in Sensor.
struct Noise {
  /// Multiplies the sensor's range_sigma; 0 measures exactly.
  double range_sigma_scale = 1;

  /// Share of echoes lost for no reason of range or surface, 0..1.
  double drop_rate = 0.03;

  /// Strength of an echo that is detected half of the time: reflectivity * cos(incidence) /
  /// range^2, in 1/m^2; 0 detects everything. The default loses asphalt at about 50 m at 1.73 m
  /// height.
  double half_detection = 2.5e-6;

  /// Chance that a beam that meets the ground 1 m away returns by way of what its mirror image
  /// hits, so that the point lies below the ground; falls with the square of the range to the
  /// ground. 0..1.
  double ghost_rate = 0.1;

  /// Longest path of a ghost by way of the ground, metres.
  double ghost_max_range = 12;

  /// Standard deviation of the intensity, which runs from 0 to 1.
  double intensity_sigma = 0.03;
};

/// Exact ranges, nothing lost, no ghosts.
Noise no_noise();

/// Is an echo of this strength reported? `range` in metres, `incidence` as a cosine.
bool is_detected(const Noise& noise, double range, double reflectivity, double incidence,
                 Random& random);

/// The range the sensor reports for an echo at `range`, metres.
double measured_range(const Noise& noise, const Sensor& sensor, double range, Random& random);

/// The intensity the sensor reports, 0..1. Beams are corrected for range, as the HDL-64E's firmware
/// does, not for incidence.
double measured_intensity(const Noise& noise, double reflectivity, double incidence,
                          Random& random);

/// Does a beam that meets the ground at `range` metres return by way of its mirror image, if that
/// hits something near enough?
bool is_mirrored(const Noise& noise, double range, Random& random);

}  // namespace flagstone::sim

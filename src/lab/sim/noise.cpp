// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/noise.hpp"

#include <algorithm>

namespace flagstone::sim {

bool is_detected(const Noise& noise, double range, double reflectivity, double incidence,
                 Random& random) {
  const double strength = reflectivity * incidence / (range * range);
  // A smooth step on a logarithmic scale that needs no logarithm.
  const double detection =
      noise.half_detection == 0
          ? 1
          : strength * strength /
                (strength * strength + noise.half_detection * noise.half_detection);
  return random.chance(detection * (1 - noise.drop_rate));
}

double measured_range(const Noise& noise, const Sensor& sensor, double range, Random& random) {
  return range + noise.range_sigma_scale * sensor.range_sigma * random.normal();
}

double measured_intensity(const Noise& noise, double reflectivity, double incidence,
                          Random& random) {
  constexpr double diffuse_share = 0.4;  // what a beam at grazing incidence loses
  const double returned = reflectivity * (1 - diffuse_share * (1 - incidence));
  return std::clamp(returned + noise.intensity_sigma * random.normal(), 0.0, 1.0);
}

bool is_mirrored(const Noise& noise, double range, Random& random) {
  return range < noise.ghost_max_range && random.chance(noise.ghost_rate / (range * range));
}

}  // namespace flagstone::sim

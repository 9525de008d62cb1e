// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone {

/// Height of the sensor itself above the ground, metres, for the few lengths that grow with it.
/// Usually the origin of the cloud is in the sensor, and this is `sensor_height`. An origin on or
/// below the ground (`sensor_height` <= 0: a map, a vehicle's base) does not tell where the sensor
/// is. These lengths are then those of the default height, so that nothing changes when all points
/// and `sensor_height` move together.
inline float mounting_height(float sensor_height) noexcept {
  constexpr float default_height = 1.73f;  // of PatchworkConfig and SurfaceConfig
  return sensor_height > 0 ? sensor_height : default_height;
}

/// z of the sensor itself, metres; 0 if the origin is in it.
inline float sensor_z(float sensor_height) noexcept {
  return mounting_height(sensor_height) - sensor_height;
}

}  // namespace flagstone

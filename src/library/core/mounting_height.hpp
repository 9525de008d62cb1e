// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone {

/// Height of the sensor itself above the ground, metres, for lengths that scale with it. Usually
/// the origin of the cloud is at the sensor, and this is `sensor_height`. If the origin is on or
/// below the ground (`sensor_height` <= 0, as in a map or a vehicle frame), the position of the
/// sensor is unknown. These lengths then use the default height, so that results do not change if
/// all points and `sensor_height` are shifted together.
inline float mounting_height(float sensor_height) noexcept {
  constexpr float default_height = 1.73f;  // as in PatchworkConfig and SurfaceConfig
  return sensor_height > 0 ? sensor_height : default_height;
}

/// z of the sensor itself, metres; 0 if the origin is at the sensor.
inline float sensor_z(float sensor_height) noexcept {
  return mounting_height(sensor_height) - sensor_height;
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/sensor_settings.hpp"

#include "lab/baselines/settings.hpp"

namespace flagstone::config {

MethodConfig settings_at_own_height(Sensor sensor,
                                    const std::function<MethodConfig(const Sensor&)>& settings_at) {
  MethodConfig config = settings_at(sensor);
  const auto usual = static_cast<float>(sensor.height);
  const float height = sensor_height_of(config, usual);
  // At 0 and below the frame's origin is not in the sensor; its own height is the better guess.
  if (height == usual || !(height > 0)) return config;
  sensor.height = height;
  return settings_at(sensor);
}

}  // namespace flagstone::config

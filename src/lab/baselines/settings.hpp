// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "flagstone/baselines.hpp"
#include "library/core/setting.hpp"
#include "library/methods/method.hpp"

namespace flagstone {

/// All settings of a baseline, in the order in which they are printed. They refer to members of
/// `config`.
std::vector<Setting> settings_of(RansacConfig& config);
std::vector<Setting> settings_of(GpfConfig& config);
std::vector<Setting> settings_of(LineFitConfig& config);
std::vector<Setting> settings_of(CascadedConfig& config);

namespace baselines {

/// `config` with the height of the sensor, if it has that setting.
inline MethodConfig at_height_of(const Sensor& sensor, MethodConfig config) {
  sensor.check();
  set_sensor_height(static_cast<float>(sensor.height), config);
  return config;
}

/// A method for which only the sensor height depends on the sensor.
template <class Config, class Segmenter>
Method baseline(std::string_view name, std::string_view title) {
  return {.name = name,
          .title = title,
          .type = &config_type<Config, Segmenter>(name),
          .defaults = [] { return Config{}; },
          .for_sensor = [](const Sensor& sensor) { return at_height_of(sensor, Config{}); }};
}

Method ransac_method();
Method gpf_method();
Method line_fit_method();
Method cascaded_method();

}  // namespace baselines
}  // namespace flagstone

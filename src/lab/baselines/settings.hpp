// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "flagstone/make_segmenter.hpp"
#include "library/core/setting.hpp"
#include "library/patchwork/patchwork_settings.hpp"
#include "library/surface/surface_settings.hpp"

namespace flagstone {

/// All settings of a baseline, in the order they are printed; they point into `config`.
std::vector<Setting> settings_of(RansacConfig& config);
std::vector<Setting> settings_of(GpfConfig& config);
std::vector<Setting> settings_of(LineFitConfig& config);
std::vector<Setting> settings_of(CascadedConfig& config);

/// Those of whatever method `config` is of; Patchwork's zones are not among them.
inline std::vector<Setting> settings_of(MethodConfig& config) {
  return std::visit([](auto& settings) { return settings_of(settings); }, config);
}

/// The sensor's height in the settings of a method, metres; `otherwise` where it has none.
inline float sensor_height_of(MethodConfig config, float otherwise) {
  for (const Setting& setting : settings_of(config)) {
    if (setting.key == "sensor_height") return *std::get<float*>(setting.value);
  }
  return otherwise;
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/patchwork_settings.hpp"
#include "core/setting.hpp"
#include "flagstone/make_segmenter.hpp"
#include "surface/surface_settings.hpp"

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

}  // namespace flagstone

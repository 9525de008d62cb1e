// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/patchwork_config.hpp"
#include "library/core/setting.hpp"

namespace flagstone {

/// All settings of `config` except the zones, in the order in which they are printed. They point
/// into `config`.
std::vector<Setting> settings_of(PatchworkConfig& config);

}  // namespace flagstone

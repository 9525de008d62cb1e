// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/surface_config.hpp"
#include "library/core/setting.hpp"

namespace flagstone {

/// All settings of `config`, in the order in which they are printed. They refer to its members.
std::vector<Setting> settings_of(SurfaceConfig& config);

}  // namespace flagstone

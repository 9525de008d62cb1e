// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/mount.hpp"
#include "library/core/setting.hpp"

namespace flagstone {

/// All settings of `settings` but the sensor's height, which every method has among its own, in the
/// order they are printed, in the table `mount`; they point into it.
std::vector<Setting> settings_of(MountSettings& settings);

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/mount.hpp"
#include "library/core/setting.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone {

/// All settings of `settings` but the sensor's height, which every method has among its own, in the
/// order they are printed, in the table `mount`; they point into it.
std::vector<Setting> settings_of(MountSettings& settings);

}  // namespace flagstone

namespace flagstone::mount {

/// The mount before any scan: the given one, `up` of unit length, or along z where tilt is off.
inline Mount expected_mount(const MountSettings& settings) noexcept {
  Mount mount = settings.mount;
  mount.up = settings.tilt == TiltSource::off ? Vector3f{0, 0, 1} : unit(mount.up);
  return mount;
}

}  // namespace flagstone::mount

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/mount.hpp"
#include "library/core/setting.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone {

/// All settings of the table `mount`, in the order in which they are printed. They point into
/// `settings`. The sensor height is not included, because every method has that setting.
std::vector<Setting> settings_of(MountSettings& settings);

}  // namespace flagstone

namespace flagstone::mount {

/// The configured mounting pose, used before the first scan. `up` has unit length and is z if the
/// tilt is off.
inline Mount expected_mount(const MountSettings& settings) noexcept {
  Mount mount = settings.mount;
  mount.up = settings.tilt == TiltSource::off ? Vector3f{0, 0, 1} : unit(mount.up);
  return mount;
}

}  // namespace flagstone::mount

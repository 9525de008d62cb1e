// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/mount.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::mount {

/// The mount before any scan: the given one, `up` of unit length, or along z where tilt is off.
inline Mount expected_mount(const MountSettings& settings) noexcept {
  Mount mount = settings.mount;
  mount.up = settings.tilt == TiltSource::off ? Vector3f{0, 0, 1} : unit(mount.up);
  return mount;
}

}  // namespace flagstone::mount

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/mount.hpp"

namespace flagstone::mount {

/// The state that `estimate` and `track` keep from scan to scan.
class MountTrack {
 public:
  /// `mount` is in use until the first scan that tells one; its `up` has unit length.
  MountTrack(const Mount& mount, bool finds_height, bool finds_tilt, const MountTracking& tracking);

  /// Has any scan told the mount?
  [[nodiscard]] bool is_told() const noexcept { return told_ > 0; }

  /// An accepted decision about the next scan. It becomes an `outlier` if it is one, and is not
  /// followed. Others are refused already and leave the state as it is.
  void take(MountDecision& decision) noexcept;

  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }

  void reset() noexcept;

 private:
  [[nodiscard]] bool is_close(const Mount& a, const Mount& b) const noexcept;
  void begin_with(const Mount& mount) noexcept;
  void move_towards(const Mount& mount) noexcept;

  Mount given_;
  bool finds_height_;
  bool finds_tilt_;
  MountTracking tracking_;
  Mount mount_;
  int told_ = 0;  // scans that have told the mount, up to `window`
  Mount last_outlier_{};
  int outliers_ = 0;  // on end, each close to the one before
};

}  // namespace flagstone::mount

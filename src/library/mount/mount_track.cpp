// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/mount_track.hpp"

#include <algorithm>
#include <cmath>

#include "library/mount/vectors.hpp"

namespace flagstone::mount {

MountTrack::MountTrack(const Mount& mount, bool finds_height, bool finds_tilt,
                       const MountTracking& tracking)
    : given_(mount),
      finds_height_(finds_height),
      finds_tilt_(finds_tilt),
      tracking_(tracking),
      mount_(mount) {}

void MountTrack::reset() noexcept {
  mount_ = given_;
  told_ = 0;
  outliers_ = 0;
}

bool MountTrack::is_close(const Mount& a, const Mount& b) const noexcept {
  const bool height_is =
      !finds_height_ || std::abs(a.sensor_height - b.sensor_height) <= tracking_.max_height_step;
  return height_is && degrees_between(a.up, b.up) <= tracking_.max_tilt_step;
}

void MountTrack::begin_with(const Mount& mount) noexcept {
  if (finds_height_) mount_.sensor_height = mount.sensor_height;
  if (finds_tilt_) mount_.up = mount.up;
  told_ = 1;
  outliers_ = 0;
}

void MountTrack::move_towards(const Mount& mount) noexcept {
  told_ = std::min(told_ + 1, tracking_.window);
  outliers_ = 0;
  const float share = 1 / static_cast<float>(told_);
  if (finds_height_) mount_.sensor_height += share * (mount.sensor_height - mount_.sensor_height);
  if (!finds_tilt_) return;
  Vector3f up = mount_.up;
  for (std::size_t i = 0; i < 3; ++i) up[i] += share * (mount.up[i] - up[i]);
  mount_.up = unit(up);
}

void MountTrack::take(MountDecision& decision) noexcept {
  if (!decision.accepted()) return;
  if (told_ == 0) {
    begin_with(decision.mount);
  } else if (is_close(decision.mount, mount_)) {
    move_towards(decision.mount);
  } else {
    outliers_ = outliers_ > 0 && is_close(decision.mount, last_outlier_) ? outliers_ + 1 : 1;
    last_outlier_ = decision.mount;
    if (outliers_ < tracking_.patience) {
      decision.verdict = MountVerdict::outlier;
    } else {
      begin_with(decision.mount);
    }
  }
}

}  // namespace flagstone::mount

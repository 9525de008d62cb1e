// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/mount_settings.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace flagstone {
namespace {

constexpr std::array<std::string_view, 3> height_sources = {"fixed", "estimate", "track"};
constexpr std::array<std::string_view, 3> tilt_sources = {"off", "fixed", "estimate"};

}  // namespace

const char* to_string(HeightSource height) noexcept {
  return height_sources[static_cast<std::size_t>(height)].data();
}

const char* to_string(TiltSource tilt) noexcept {
  return tilt_sources[static_cast<std::size_t>(tilt)].data();
}

const char* to_string(MountVerdict verdict) noexcept {
  switch (verdict) {
    case MountVerdict::fixed: return "fixed";
    case MountVerdict::accepted: return "accepted";
    case MountVerdict::too_few_points: return "too_few_points";
    case MountVerdict::no_plane: return "no_plane";
    case MountVerdict::obstructed: return "obstructed";
    case MountVerdict::points_below: return "points_below";
    case MountVerdict::one_sided: return "one_sided";
    case MountVerdict::height_limit: return "height_limit";
    case MountVerdict::tilt_limit: return "tilt_limit";
    case MountVerdict::outlier: return "outlier";
  }
  return "unknown";
}

std::vector<Setting> settings_of(MountSettings& s) {
  return {
      {"mount.height", Choice(s.height, height_sources),
       "source of the sensor height: sensor_height (fixed), the first scan that determines it "
       "(estimate), or the running mean over all scans (track)"},
      {"mount.tilt", Choice(s.tilt, tilt_sources),
       "source of the up direction: z (off), mount.up (fixed), or the scans (estimate)"},
      {"mount.up",
       &s.mount.up,
       "up direction in the frame of the cloud, of any length, for example the negated gravity "
       "vector of an IMU",
       {.low = -1000, .high = 1000}},
      {"mount.origin",
       &s.mount.origin,
       "position of the sensor in the frame of the cloud",
       {.low = -10000, .high = 10000, .unit = "m"}},
      {"mount.scale",
       &s.mount.scale,
       "metres per unit of the cloud, for example 0.001 for millimetres",
       {.low = 1e-6, .high = 1e6}},
      {"mount.min_height",
       &s.limits.min_height,
       "minimum height of the sensor above the ground; lower estimates are rejected",
       {.low = 0.01, .high = 100, .unit = "m"}},
      {"mount.max_height",
       &s.limits.max_height,
       "maximum height of the sensor above the ground; higher estimates are rejected",
       {.low = 0.01, .high = 100, .unit = "m", .remark = "above min_height"}},
      {"mount.max_tilt",
       &s.limits.max_tilt,
       "maximum angle between the estimated and the configured up direction; estimates beyond it "
       "are rejected",
       {.low = 0, .high = 45, .unit = "degrees"}},
      {"mount.min_confidence",
       &s.limits.min_confidence,
       "minimum confidence of an estimate; estimates with a lower confidence are rejected",
       {.low = 0, .high = 1}},
      {"mount.ego_radius",
       &s.limits.ego_radius,
       "points nearer to the sensor than this belong to the ego vehicle and are ignored in "
       "estimates",
       {.low = 0, .high = 60, .unit = "m", .remark = "at most two thirds of reach"}},
      {"mount.reach",
       &s.limits.reach,
       "points farther from the sensor than this are ignored in estimates; if no ground is near "
       "enough, the limit is 2.5 times as large",
       {.low = 2, .high = 100, .unit = "m"}},
      {"mount.window",
       &s.tracking.window,
       "number of scans in the running mean of `track`",
       {.low = 1, .high = 10000}},
      {"mount.max_height_step",
       &s.tracking.max_height_step,
       "`track` rejects an estimate whose height differs from the running mean by more than this",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"mount.max_tilt_step",
       &s.tracking.max_tilt_step,
       "`track` rejects an estimate whose up direction differs from the running mean by more than "
       "this",
       {.low = 0, .high = 90, .unit = "degrees", .exclusive_min = true}},
      {"mount.patience",
       &s.tracking.patience,
       "number of consecutive rejected scans that must agree before `track` accepts them as the "
       "new state",
       {.low = 1, .high = 10000}},
  };
}

void MountSettings::check() const {
  MountSettings copy = *this;
  check_number("mount", "sensor_height", mount.sensor_height,
               {.low = -100, .high = 100, .unit = "m"});
  check_settings("mount", settings_of(copy));
  if (limits.max_height <= limits.min_height) {
    throw_out_of_range("mount", "mount.max_height", limits.max_height, "above min_height");
  }
  if (limits.reach < 1.5f * limits.ego_radius) {
    throw_out_of_range("mount", "mount.reach", limits.reach, "at least 1.5 times ego_radius");
  }
  const float length = std::hypot(mount.up[0], mount.up[1], mount.up[2]);
  if (length < 1e-6f) throw_out_of_range("mount", "length of mount.up", length, "more than 0");
}

}  // namespace flagstone

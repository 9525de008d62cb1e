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
       "where the sensor's height is from: sensor_height, the first scan that tells it, or every "
       "scan, smoothed"},
      {"mount.tilt", Choice(s.tilt, tilt_sources),
       "where up is from: off is z; fixed is `up`; estimate asks the scans"},
      {"mount.up",
       &s.mount.up,
       "up in the cloud's frame, of any length: minus what an IMU measures as gravity",
       {.low = -1000, .high = 1000}},
      {"mount.origin",
       &s.mount.origin,
       "the sensor in the cloud's frame",
       {.low = -10000, .high = 10000, .unit = "m"}},
      {"mount.scale",
       &s.mount.scale,
       "metres a unit of the cloud, 0.001 for millimetres",
       {.low = 1e-6, .high = 1e6}},
      {"mount.min_height",
       &s.limits.min_height,
       "estimates below are not believed",
       {.low = 0.01, .high = 100, .unit = "m"}},
      {"mount.max_height",
       &s.limits.max_height,
       "nor are those above",
       {.low = 0.01, .high = 100, .unit = "m", .remark = "above min_height"}},
      {"mount.max_tilt",
       &s.limits.max_tilt,
       "nor what leans more from the given up",
       {.low = 0, .high = 45, .unit = "degrees"}},
      {"mount.min_confidence",
       &s.limits.min_confidence,
       "nor what scans are less sure of",
       {.low = 0, .high = 1}},
      {"mount.ego_radius",
       &s.limits.ego_radius,
       "points nearer than this are the own vehicle",
       {.low = 0, .high = 60, .unit = "m", .remark = "at most two thirds of reach"}},
      {"mount.reach",
       &s.limits.reach,
       "points farther away do not tell the ground below the vehicle",
       {.low = 2, .high = 100, .unit = "m"}},
      {"mount.window",
       &s.tracking.window,
       "scans that `track` averages over",
       {.low = 1, .high = 10000}},
      {"mount.max_height_step",
       &s.tracking.max_height_step,
       "`track` refuses scans that differ by more",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"mount.max_tilt_step",
       &s.tracking.max_tilt_step,
       "the same for the tilt",
       {.low = 0, .high = 90, .unit = "degrees", .exclusive_min = true}},
      {"mount.patience",
       &s.tracking.patience,
       "so many refused scans on end that agree are believed",
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

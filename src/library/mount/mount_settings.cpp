// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/mount_settings.hpp"

#include <array>
#include <cmath>
#include <string_view>

namespace flagstone {
namespace {

constexpr std::array<std::string_view, 3> height_sources = {"fixed", "estimate", "track"};
constexpr std::array<std::string_view, 3> tilt_sources = {"off", "given", "estimate"};

}  // namespace

const char* to_string(HeightSource height) noexcept {
  return height_sources[static_cast<std::size_t>(height)].data();
}

const char* to_string(TiltSource tilt) noexcept {
  return tilt_sources[static_cast<std::size_t>(tilt)].data();
}

const char* to_string(MountVerdict verdict) noexcept {
  switch (verdict) {
    case MountVerdict::given: return "given";
    case MountVerdict::accepted: return "accepted";
    case MountVerdict::too_few_points: return "too_few_points";
    case MountVerdict::no_level: return "no_level";
    case MountVerdict::not_free: return "not_free";
    case MountVerdict::not_lowest: return "not_lowest";
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
       "where up is from: off is z; given is `up`; estimate asks the scans"},
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
      {"mount.least_height",
       &s.limits.least_height,
       "estimates below are not believed",
       {.low = 0.01, .high = 100, .unit = "m"}},
      {"mount.most_height",
       &s.limits.most_height,
       "nor are those above",
       {.low = 0.01, .high = 100, .unit = "m", .remark = "above least_height"}},
      {"mount.most_tilt",
       &s.limits.most_tilt,
       "nor what leans more from the given up",
       {.low = 0, .high = 45, .unit = "degrees"}},
      {"mount.least_confidence",
       &s.limits.least_confidence,
       "nor what scans are less sure of",
       {.low = 0, .high = 1}},
      {"mount.own_vehicle",
       &s.limits.own_vehicle,
       "points nearer than this are the own vehicle",
       {.low = 0, .high = 60, .unit = "m", .remark = "at most two thirds of reach"}},
      {"mount.reach",
       &s.limits.reach,
       "points farther away do not tell the ground below the vehicle",
       {.low = 2, .high = 100, .unit = "m"}},
      {"mount.memory",
       &s.tracking.memory,
       "scans that `track` averages over",
       {.low = 1, .high = 10000}},
      {"mount.most_jump",
       &s.tracking.most_jump,
       "`track` refuses scans that differ by more",
       {.low = 0, .high = 100, .unit = "m", .without_low = true}},
      {"mount.most_turn",
       &s.tracking.most_turn,
       "the same for the tilt",
       {.low = 0, .high = 90, .unit = "degrees", .without_low = true}},
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
  if (limits.most_height <= limits.least_height) {
    refuse_setting("mount", "mount.most_height", limits.most_height, "above least_height");
  }
  if (limits.reach < 1.5f * limits.own_vehicle) {
    refuse_setting("mount", "mount.reach", limits.reach, "at least 1.5 times own_vehicle");
  }
  const float length = std::hypot(mount.up[0], mount.up[1], mount.up[2]);
  if (length < 1e-6f) refuse_setting("mount", "length of mount.up", length, "more than 0");
}

}  // namespace flagstone

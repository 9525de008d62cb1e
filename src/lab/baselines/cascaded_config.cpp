// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <string>
#include <string_view>

#include "flagstone/baselines/cascaded.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone {
namespace {

constexpr std::string_view method = "cascaded";

constexpr ValidRange elevation_range = {.low = -89, .high = 89, .unit = "degrees"};

void check_beams(const std::vector<float>& elevations) {
  check_number(method, "length of beam_elevations", static_cast<double>(elevations.size()),
               {.low = 2, .high = 1000, .unit = "beams"});
  for (std::size_t i = 1; i < elevations.size(); ++i) {
    check_number(method, "beam_elevations[" + std::to_string(i) + "]", elevations[i],
                 {.low = elevations[i - 1],
                  .high = elevation_range.high,
                  .unit = elevation_range.unit,
                  .exclusive_min = true,
                  .remark = "ascending, the lowest beam first"});
  }
}

}  // namespace

// Velodyne, "HDL-64E S2 and S2.1 User's Manual and Programming Guide": 32 lasers 1/2 degree apart
// up to -8.83 degrees, above them 32 lasers 1/3 degree apart up to 2.
std::vector<float> CascadedConfig::hdl_64e_elevations() {
  std::vector<float> elevations;
  for (int i = 31; i >= 0; --i) elevations.push_back(static_cast<float>(-53.0 / 6 - i / 2.0));
  for (int i = 31; i >= 0; --i) elevations.push_back(static_cast<float>(2 - i / 3.0));
  return elevations;
}

std::vector<Setting> settings_of(CascadedConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "sensor above ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"max_range",
       &c.max_range,
       "points from here on are out of range",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"beam_elevations", &c.beam_elevations, "angle of each beam, the lowest first",
       elevation_range},
      {"columns",
       &c.columns,
       "directions in which points count as one above the other",
       {.low = 1, .high = 3600}},
      {"max_slope",
       &c.max_slope,
       "steepest rise of the ground: rings closer together have met an object",
       {.low = 0, .high = 45, .unit = "degrees"}},
      {"min_object_height",
       &c.min_object_height,
       "what such rings met is an object if it is higher",
       {.low = 0, .high = 100, .unit = "m"}},
      {"sections",
       &c.sections,
       "regions outward, in each of four directions",
       {.low = 1, .high = 100}},
      {"max_distance",
       &c.max_distance,
       "points at most this far from their plane are ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"max_trials",
       &c.max_trials,
       "samples drawn for a plane at most",
       {.low = 1, .high = 1000000}},
      {"max_angle_change",
       &c.max_angle_change,
       "how far a plane may lean against the one before it",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"max_height_change",
       &c.max_height_change,
       "how far a plane may lie from the one before it where they meet",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"seed", &c.seed, "start of the random numbers", {.low = 0, .high = 1e9}},
  };
}

void CascadedConfig::check() const {
  CascadedConfig copy = *this;  // settings point into something that may be written to
  check_settings(method, settings_of(copy));
  check_beams(beam_elevations);
}

}  // namespace flagstone

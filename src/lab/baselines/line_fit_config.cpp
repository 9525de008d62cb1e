// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <string_view>

#include "flagstone/baselines/line_fit.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone {
namespace {

constexpr std::string_view method = "line_fit";

constexpr ValidRange distance(double high, bool allow_infinity = false) {
  return {
      .low = 0, .high = high, .unit = "m", .exclusive_min = true, .allow_infinity = allow_infinity};
}

}  // namespace

std::vector<Setting> settings_of(LineFitConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "sensor above ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"min_range",
       &c.min_range,
       "nearer points are out of range",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"max_range", &c.max_range, "points from here on are out of range", distance(1000)},
      {"segments", &c.segments, "S: segments of a turn", {.low = 1, .high = 3600}},
      {"bins", &c.bins, "B: bins of a segment", {.low = 3, .high = 1000}},
      {"max_slope", &c.max_slope, "T_m: steepest line", {.low = 0, .high = 10, .unit = "m/m"}},
      {"flat_slope",
       &c.flat_slope,
       "T_m_small: flatter lines are judged by max_intercept",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"max_intercept", &c.max_intercept,
       "T_b: how far from the ground below the sensor a nearly flat line may pass",
       distance(1000, true)},
      {"max_fit_error", &c.max_fit_error, "T_RMSE: largest residual of a line", distance(100)},
      {"max_start_height", &c.max_start_height,
       "T_dprev: how far above or below the end of the last line the next may begin",
       distance(100)},
      {"long_gap", &c.long_gap, "a line of two points crosses no longer gap", distance(1000)},
      {"max_gap_height", &c.max_gap_height, "how far off the line a point beyond such a gap may be",
       distance(100)},
      {"max_distance", &c.max_distance, "T_dground: nearer points are ground", distance(100)},
      {"search_angle",
       &c.search_angle,
       "how far to either side a line is looked for",
       {.low = 0, .high = 180, .unit = "degrees"}},
  };
}

void LineFitConfig::check() const {
  LineFitConfig copy = *this;  // settings point into something that may be written to
  check_settings(method, settings_of(copy));
  check_number(method, "max_range", max_range,
               {.low = min_range,
                .high = 1000,
                .unit = "m",
                .exclusive_min = true,
                .remark = "from min_range on"});
  check_number(method, "number of bins (segments times bins)", static_cast<double>(segments) * bins,
               {.low = 3, .high = 65535});
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/ransac.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone {

std::vector<Setting> settings_of(RansacConfig& c) {
  return {
      {"distance_threshold",
       &c.distance_threshold,
       "points at most this far from the plane agree with it",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"confidence",
       &c.confidence,
       "z: probability wanted of one trial without outliers",
       {.low = 0, .high = 0.999999, .exclusive_min = true}},
      {"max_trials",
       &c.max_trials,
       "trials after which the search ends",
       {.low = 1, .high = 1000000}},
      {"min_consensus",
       &c.min_consensus,
       "t: a plane that fewer points agree on is none",
       {.low = 3, .high = 1000000}},
      {"seed", &c.seed, "start of the random numbers", {.low = 0, .high = 1e9}},
  };
}

void RansacConfig::check() const {
  RansacConfig copy = *this;  // settings point into something that may be written to
  check_settings("ransac", settings_of(copy));
}

}  // namespace flagstone

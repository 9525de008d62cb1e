// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/beams.hpp"
#include "lab/sim/noise.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// What befalls many beams of a scan together, drawn before they are cast.
class Bursts {
 public:
  Bursts(const Noise& noise, const Sensor& sensor, const Beams& beams, std::uint64_t seed);

  /// Is the beam in a block that was lost on the way from the sensor?
  [[nodiscard]] bool is_lost(std::size_t beam) const noexcept {
    return !lost_.empty() && lost_[beam];
  }

  /// The range that the light of another sensor made up, metres, if it hit this beam.
  [[nodiscard]] std::optional<double> crosstalk(std::size_t beam) const noexcept {
    if (crosstalk_.empty() || crosstalk_[beam] == 0) return std::nullopt;
    return crosstalk_[beam];
  }

 private:
  void lose_blocks(double rate, const Beams& beams, Random random);
  void add_crosstalk(double rate, const Sensor& sensor, const Beams& beams, Random random);

  std::vector<bool> lost_;         // one a beam, or empty: none is
  std::vector<double> crosstalk_;  // one a beam, 0 where there is none, or empty
};

}  // namespace flagstone::sim

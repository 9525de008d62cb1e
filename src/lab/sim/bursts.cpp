// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/bursts.hpp"

#include <algorithm>

namespace flagstone::sim {
namespace {

// A whole number with this mean.
std::size_t drawn_count(double mean, Random& random) {
  const auto whole = static_cast<std::size_t>(mean);
  return whole + (random.chance(mean - static_cast<double>(whole)) ? 1 : 0);
}

// Below `count`, which is not 0.
std::size_t drawn_index(std::size_t count, Random& random) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

}  // namespace

Bursts::Bursts(const Noise& noise, const Sensor& sensor, const Beams& beams, std::uint64_t seed) {
  if (noise.block_loss_rate > 0) {
    lose_blocks(noise.block_loss_rate, beams, Random::stream(seed, 0));
  }
  if (noise.crosstalk_rate > 0) {
    add_crosstalk(noise.crosstalk_rate, sensor, beams, Random::stream(seed, 1));
  }
}

// A packet of the sensor: some firings of neighbouring rows.
void Bursts::lose_blocks(double rate, const Beams& beams, Random random) {
  constexpr std::size_t blocks_a_row = 60;
  constexpr std::size_t blocks_a_column = 4;
  const std::size_t rows = beams.size() / beams.row_length();
  const std::size_t width = (beams.row_length() + blocks_a_row - 1) / blocks_a_row;
  const std::size_t height = (rows + blocks_a_column - 1) / blocks_a_column;
  lost_.resize(beams.size());
  const auto block = static_cast<double>(width * height);
  for (std::size_t left = drawn_count(rate * static_cast<double>(beams.size()) / block, random);
       left > 0; --left) {
    const std::size_t first_row = drawn_index(rows - height + 1, random);
    const std::size_t first = drawn_index(beams.row_length() - width + 1, random);
    for (std::size_t row = first_row; row < first_row + height; ++row) {
      for (std::size_t i = first; i < first + width; ++i)
        lost_[row * beams.row_length() + i] = true;
    }
  }
}

// While the two sensors look at each other, the range that is made up drifts with the difference of
// their clocks: a streak of points.
void Bursts::add_crosstalk(double rate, const Sensor& sensor, const Beams& beams, Random random) {
  constexpr std::size_t shortest = 8;  // firings
  constexpr std::size_t longest = 40;
  constexpr double share_hit = 0.75;
  constexpr double mean_hits = share_hit * (shortest + longest) / 2;
  constexpr double farthest = 60;  // metres
  constexpr double drift = 1;      // metres a firing
  constexpr double jitter = 0.3;   // metres
  const double reach = std::min(sensor.max_range, sensor.min_range + farthest);
  crosstalk_.resize(beams.size());
  for (std::size_t left = drawn_count(rate * static_cast<double>(beams.size()) / mean_hits, random);
       left > 0; --left) {
    const std::size_t first = drawn_index(beams.size(), random);
    const std::size_t row_end = (first / beams.row_length() + 1) * beams.row_length();
    const std::size_t end =
        std::min(first + shortest + drawn_index(longest - shortest + 1, random), row_end);
    double range = random.uniform(sensor.min_range, reach);
    const double step = random.uniform(-drift, drift);
    for (std::size_t beam = first; beam < end; ++beam, range += step) {
      const double made_up = range + random.uniform(-jitter, jitter);
      const bool hit = random.chance(share_hit);
      // What drifts out of reach comes in again at the other end, as a clock does.
      if (range < sensor.min_range) range = reach;
      if (range > reach) range = sensor.min_range;
      if (hit) crosstalk_[beam] = std::clamp(made_up, sensor.min_range, sensor.max_range);
    }
  }
}

}  // namespace flagstone::sim

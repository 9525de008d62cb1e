// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/sample_times.hpp"
#include "flagstone/stage_times.hpp"

namespace flagstone::bench {

/// What a contestant took and found.
struct Measured {
  explicit Measured(std::size_t scans) : times(scans), ground(scans) {}

  SampleTimes times;
  /// Points of each scan that it found ground; none of those it did not come to.
  std::vector<std::optional<std::size_t>> ground;
};

/// A program of other people's.
struct PeerResult {
  std::string name;
  Measured measured;
  std::string left_out;  ///< why it was not measured, or not to the end; else empty
};

/// What came of a benchmark.
struct Results {
  explicit Results(std::vector<std::size_t> points_of_scans)
      : points(std::move(points_of_scans)),
        segment(points.size()),
        floor(points.size()),
        scalar(points.size()),
        stages(stage_count, SampleTimes(points.size())) {}

  std::vector<std::size_t> points;  ///< of each scan
  std::size_t rounds = 0;           ///< that were begun, after warming up
  std::string target;               ///< instruction set
  unsigned threads = 1;
  std::optional<int> core;  ///< that everything ran on; none where it was free to move
  Measured segment;
  Measured floor;                   ///< the bare pass
  Measured scalar;                  ///< Patchwork without vectors
  std::vector<SampleTimes> stages;  ///< in the order of `Stage`
  std::vector<PeerResult> peers;
  std::optional<std::size_t> allocations;  ///< most in one scan; none where nobody counts
  std::optional<std::size_t> bytes_held;   ///< by segmenter and result, once warm
};

/// Share of the points that were found ground, 0 to 1, over all scans it came to; not a number
/// where there is none.
[[nodiscard]] double ground_share(const Results& results, const Measured& measured);

}  // namespace flagstone::bench

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flagstone/stage_times.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/bench/sample_times.hpp"

namespace flagstone::bench {

/// What a candidate took and found.
struct Measured {
  explicit Measured(std::size_t scans) : times(scans), ground(scans) {}

  SampleTimes times;
  /// Points of each scan that it found ground; none of those it did not come to.
  std::vector<std::optional<std::size_t>> ground;
};

/// A program of other people's.
struct ExternalToolResult {
  std::string name;
  Measured measured;
  std::string left_out;  ///< why it was not measured, or not to the end; else empty
};

/// What a stage of the method took.
struct StageResult {
  Stage stage;
  SampleTimes times;
};

/// What came of a benchmark.
struct Results {
  /// `name` is one of `timed_methods`.
  Results(std::string_view name, std::vector<std::size_t> points_of_scans)
      : method(name),
        points(std::move(points_of_scans)),
        segment(points.size()),
        floor(points.size()),
        scalar(points.size()) {
    for (const Stage stage : stages_of(name)) {
      stages.push_back({.stage = stage, .times = SampleTimes(points.size())});
    }
  }

  std::string method;               ///< its name
  std::vector<std::size_t> points;  ///< of each scan
  std::size_t rounds = 0;           ///< that were begun, after warming up
  std::string target;               ///< instruction set
  unsigned threads = 1;
  std::optional<int> core;  ///< that everything ran on; none where it was free to move
  Measured segment;
  Measured floor;                   ///< the read baseline
  Measured scalar;                  ///< the method without vectors
  std::vector<StageResult> stages;  ///< those that the method has, in order
  std::vector<ExternalToolResult> external_tools;
  std::optional<std::size_t> allocations;  ///< most in one scan; none where nobody counts
  std::optional<std::size_t> bytes_held;   ///< by segmenter and result, once warm
};

/// Share of the points that were found ground, 0 to 1, over all scans it came to; not a number
/// where there is none.
[[nodiscard]] double ground_share(const Results& results, const Measured& measured);

/// Results as one object. `method` is the name of the one timed. Times are milliseconds a scan;
/// ratios are medians over scans and rounds: `ratio_to_floor` and `ratio_to_scalar` of segment's
/// time to the read baseline's and the scalar build's, `ratio` of a stage's time to the read
/// baseline's and of an external tool's to segment's. What was not measured is null, and an
/// external tool that is not there has `left_out`, the reason.
[[nodiscard]] nlohmann::ordered_json to_json(const Results& results);

/// Results as tables, with what they were measured on above them.
[[nodiscard]] std::string to_text(const Results& results);

}  // namespace flagstone::bench

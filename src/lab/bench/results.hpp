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

/// Times and results of a candidate.
struct Measured {
  explicit Measured(std::size_t scans) : times(scans), ground(scans) {}

  SampleTimes times;
  /// Number of points labelled ground per scan; unset for scans that were not processed.
  std::vector<std::optional<std::size_t>> ground;
};

/// Result of an external tool.
struct ExternalToolResult {
  std::string name;
  Measured measured;
  std::string left_out;  ///< why it was not measured completely; otherwise empty
};

/// Times of one stage of the method.
struct StageResult {
  Stage stage;
  SampleTimes times;
};

/// Results of a benchmark.
struct Results {
  /// `name` must be one of `timed_methods`.
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

  std::string method;               ///< name of the method
  std::vector<std::size_t> points;  ///< points per scan
  std::size_t rounds = 0;           ///< number of rounds begun after warm-up
  std::string target;               ///< instruction set
  unsigned threads = 1;
  std::optional<int> core;  ///< core that everything ran on; unset if not pinned
  Measured segment;
  Measured floor;                   ///< the read-only baseline
  Measured scalar;                  ///< the method without vectors
  std::vector<StageResult> stages;  ///< stages of the method, in order
  std::vector<ExternalToolResult> external_tools;
  std::optional<std::size_t> allocations;  ///< maximum per scan; unset if not counted
  std::optional<std::size_t> bytes_held;   ///< by segmenter and result, after warm-up
};

/// Fraction of the points labelled ground, 0 to 1, over all processed scans; NaN if there are none.
[[nodiscard]] double ground_share(const Results& results, const Measured& measured);

/// Results as one JSON object. `method` is the name of the timed method. Times are in milliseconds
/// per scan. Ratios are medians over scans and rounds: `ratio_to_floor` and `ratio_to_scalar` are
/// the time of `segment` relative to the read-only baseline and to the scalar build; `ratio` is the
/// time of a stage relative to the read-only baseline, or of an external tool relative to
/// `segment`. Values that were not measured are null. An excluded external tool has the reason in
/// `left_out`.
[[nodiscard]] nlohmann::ordered_json to_json(const Results& results);

/// Results as tables, with the machine and the scans in the heading.
[[nodiscard]] std::string to_text(const Results& results);

}  // namespace flagstone::bench

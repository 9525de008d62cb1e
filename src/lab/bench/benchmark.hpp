// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/bench/external_tool.hpp"
#include "lab/bench/results.hpp"

namespace flagstone::bench {

/// Order of the candidates 0 to `candidates` - 1 in a round. Each candidate is first in turn, and
/// every second round is reversed, so that no candidate always follows the same one.
[[nodiscard]] std::vector<std::size_t> order_of_round(std::size_t candidates, std::size_t round);

/// Runs a candidate on the scans 0 to `scans` - 1 in turn: first in its untimed passes, then in a
/// pass whose trials are passed to `note`. Returns early if `stop` returns true.
void run_passes(Candidate& candidate, std::size_t scans,
                const std::function<void(std::size_t scan, const Trial&)>& note,
                const std::function<bool()>& stop);

/// Settings of a benchmark.
struct BenchmarkSettings {
  TimedConfig config = {};   ///< settings of the timed method
  MountSettings mount = {};  ///< tilt of the sensor; the height is a setting of the method
  unsigned threads = 1;      ///< threads per scan; with 1, everything is pinned to one core
  std::string target = {};   ///< instruction set; empty for the best one
  std::size_t rounds = 0;    ///< rounds over all scans; 0 for about ten seconds
  std::optional<ExternalToolPaths> external_tools = {};  ///< if set, external tools are timed too
};

/// Callbacks for progress and interruption.
struct BenchmarkWatch {
  /// Called repeatedly, first before the first round.
  std::function<void(std::size_t rounds_done, std::size_t rounds)> progress;
  std::function<bool()> stop;
};

/// Measures how long a method takes on each scan, together with the read-only baseline, the scalar
/// build of the method and external tools. Each scan must have at least one point. In a round, each
/// candidate processes all scans before the next candidate starts, so a scan is not accessed for a
/// whole rotation and is not in the cache. The order of candidates changes from round to round.
/// The read-only baseline processes all scans twice and only the second pass is timed, so it finds
/// the caches as another pass of the baseline left them.
/// External tools are slow and run in fewer rounds, so that they take about as long as all others
/// together. If `watch.stop` returns true, the results measured so far are returned. Throws
/// std::invalid_argument for invalid settings, and std::runtime_error if a scan cannot be
/// segmented.
[[nodiscard]] Results run_benchmark(std::span<const io::Cloud> scans,
                                    const BenchmarkSettings& settings, const BenchmarkWatch& watch);

}  // namespace flagstone::bench

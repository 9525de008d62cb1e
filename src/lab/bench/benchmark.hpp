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

/// In which order the candidates 0 to `candidates` - 1 go in this round: each begins in turn, and
/// every other round goes backwards, so that none always follows the same one.
[[nodiscard]] std::vector<std::size_t> order_of_round(std::size_t candidates, std::size_t round);

/// What is measured.
struct BenchmarkSettings {
  TimedConfig config = {};   ///< of the method that is timed
  MountSettings mount = {};  ///< how the sensor stands; its height is the method's
  unsigned threads = 1;      ///< on one scan; with one, all that is timed shares one core
  std::string target = {};   ///< instruction set; empty for the best
  std::size_t rounds = 0;    ///< over all scans; 0 for as many as take about ten seconds
  std::optional<ExternalToolPaths> external_tools =
      {};  ///< compares with other people's programs too
};

/// Who wants to know how far it is, and who may stop it.
struct BenchmarkWatch {
  /// Called now and then, before the first round at the latest.
  std::function<void(std::size_t rounds_done, std::size_t rounds)> progress;
  std::function<bool()> stop;
};

/// Times a method on scans, each at least one point, beside the read baseline, its own scalar build
/// and external tools. All take every scan of a round, one candidate after the other, so that a
/// scan was not touched for a whole rotation when its turn comes; the order of candidates changes
/// from round to round. External tools, which are slow, join in fewer rounds, so that they take
/// about as long as the others together. What was measured until `watch.stop` is returned. Throws
/// std::invalid_argument for settings that are not allowed, and std::runtime_error where a scan
/// cannot be segmented.
[[nodiscard]] Results run_benchmark(std::span<const io::Cloud> scans,
                                    const BenchmarkSettings& settings, const BenchmarkWatch& watch);

}  // namespace flagstone::bench

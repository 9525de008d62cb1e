// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flagstone::bench {

/// Times of one candidate for each scan of each round, in milliseconds. Rounds, or parts of rounds,
/// can be missing.
class SampleTimes {
 public:
  /// `scans`: number of scans per round, at least 1.
  explicit SampleTimes(std::size_t scans) : scans_(scans) {}

  /// Records the time of a scan in a round; `scan` must be less than the number of scans per round.
  void add(std::size_t round, std::size_t scan, double milliseconds);

  /// Number of recorded times.
  [[nodiscard]] std::size_t count() const;

  /// Median of all times; NaN if there are none.
  [[nodiscard]] double median() const;

  /// The 99th percentile by nearest rank: the smallest time that at least 99 % of the times do not
  /// exceed.
  [[nodiscard]] double percentile_99() const;

  /// Median ratio of these times to the times of `other` for the same round and scan; NaN if no
  /// round and scan is in both.
  [[nodiscard]] double ratio_to(const SampleTimes& other) const;

  /// Median of points per second. `points` contains the number of points per scan.
  [[nodiscard]] double points_per_second(std::span<const std::size_t> points) const;

 private:
  [[nodiscard]] std::vector<double> known() const;

  std::size_t scans_;
  std::vector<double> times_;  // round by round; NaN for missing times
};

}  // namespace flagstone::bench

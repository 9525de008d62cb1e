// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flagstone::bench {

/// What one candidate took for each scan of each round, in milliseconds; there are rounds, or
/// parts of them, in which it was not asked.
class SampleTimes {
 public:
  /// `scans`: how many there are in a round, at least 1.
  explicit SampleTimes(std::size_t scans) : scans_(scans) {}

  /// What it took for a scan, below the number given above, in a round.
  void add(std::size_t round, std::size_t scan, double milliseconds);

  /// How many times there are.
  [[nodiscard]] std::size_t count() const;

  /// Over all times; not a number where there is none.
  [[nodiscard]] double median() const;

  /// The 99th percentile by nearest rank: the smallest time that 99 % of them do not exceed.
  [[nodiscard]] double percentile_99() const;

  /// The median over rounds and scans of this time by the other's of the same round and scan; not a
  /// number where they share none.
  [[nodiscard]] double ratio_to(const SampleTimes& other) const;

  /// The median of points a second, where `points` are those of each scan.
  [[nodiscard]] double points_per_second(std::span<const std::size_t> points) const;

 private:
  [[nodiscard]] std::vector<double> known() const;

  std::size_t scans_;
  std::vector<double> times_;  // round by round; not a number where it was not asked
};

}  // namespace flagstone::bench

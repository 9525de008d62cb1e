// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/status.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::eval {

/// Moving points to evaluate, from a mapped run or another program.
struct MovingSource {
  std::string name;              ///< a name given by the user
  std::filesystem::path folder;  ///< directory with one file per scan, see moving_file()
};

/// Counts of points that are marked as moving, compared with the ground truth.
struct MovingCounts {
  Confusion points;      ///< positive: moving; "ground" in the metrics of Confusion is "moving"
  double obstacles = 0;  ///< static points that are not ground
  double kept = 0;       ///< number of these that are not marked

  MovingCounts& operator+=(const MovingCounts& other) noexcept {
    points += other.points;
    obstacles += other.obstacles;
    kept += other.kept;
    return *this;
  }

  /// Number of moving points in the ground truth.
  [[nodiscard]] double moving() const noexcept {
    return points.true_positives + points.false_negatives;
  }
  /// Number of points marked as moving.
  [[nodiscard]] double marked() const noexcept {
    return points.true_positives + points.false_positives;
  }
  /// Fraction of the static points that are not ground and not marked; NaN without such points.
  [[nodiscard]] double kept_share() const noexcept { return kept / obstacles; }
};

/// Score of the moving points of one scan. Points beyond the last range band are not scored.
struct MovingScore {
  MovingCounts all;  ///< the sum of the bands
  std::array<MovingCounts, range_bands.size()> by_range{};
};

/// The ground truth of moving points, from SemanticKITTI classes. Classes 0 (unlabelled) and 1
/// (outlier) are not scored, 251 to 259 move, and all others are static. Reuses its memory. Not
/// thread-safe: use one instance per thread.
class MovingTruth {
 public:
  /// `classes` contains one id per point of `cloud`.
  void set(CloudView cloud, std::span<const std::uint32_t> classes);

  /// Scores marks, one per point of the cloud passed to set(): nonzero for points that move.
  [[nodiscard]] MovingScore score(std::span<const std::uint32_t> marks) const noexcept;

 private:
  std::vector<std::uint8_t> groups_;  // per point: range band and kind
};

/// Reads the marks of one scan: nonzero for points that move. A .label file contains SemanticKITTI
/// classes, and 251 to 259 move; in other files every number except 0 moves. Errors as
/// io::read_reference().
Status read_moving(const std::filesystem::path& file, std::size_t expected_points,
                   std::vector<std::uint32_t>& marks);

}  // namespace flagstone::eval

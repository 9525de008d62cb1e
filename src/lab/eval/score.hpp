// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "lab/eval/protocol.hpp"
#include "library/core/truth.hpp"

namespace flagstone::eval {
/// How labels compare with the ground truth; section IV-B of the paper, equation (1). In points, or
/// in cells where each counts once. All scores are ratios from 0 to 1, or NaN where they are
/// undefined: without ground in the ground truth only the accuracy is defined, without points
/// labelled ground the precision is undefined too.
struct Confusion {
  double true_positives = 0;
  double false_positives = 0;
  double false_negatives = 0;
  double true_negatives = 0;

  Confusion& operator+=(const Confusion& other) noexcept;

  /// Is there ground in the ground truth?
  [[nodiscard]] bool has_ground() const noexcept { return true_positives + false_negatives > 0; }

  /// All that was scored.
  [[nodiscard]] double total() const noexcept {
    return true_positives + false_positives + false_negatives + true_negatives;
  }

  [[nodiscard]] double precision() const noexcept {
    return has_ground() ? true_positives / (true_positives + false_positives) : undefined;
  }
  [[nodiscard]] double recall() const noexcept {
    return true_positives / (true_positives + false_negatives);
  }
  [[nodiscard]] double f1() const noexcept {
    if (!has_ground()) return undefined;
    return 2 * true_positives / (2 * true_positives + false_positives + false_negatives);
  }
  [[nodiscard]] double accuracy() const noexcept {
    return (true_positives + true_negatives) / total();
  }
  /// Intersection over union of found and true ground.
  [[nodiscard]] double iou() const noexcept {
    if (!has_ground()) return undefined;
    return true_positives / (true_positives + false_positives + false_negatives);
  }

 private:
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
};

/// "95.12" for a ratio of 0.9512, "n/a" for one that is undefined.
std::string percent_text(double ratio);

/// "precision 95.12 %, recall 93.00 %, F1 94.05 %"; says so if there is no ground to be found.
std::string scores_text(const Confusion& confusion);

/// Compares labels with the truth, one of each per point. Whatever is not labelled ground counts as
/// not ground; ignored points are left out.
Confusion compare(std::span<const Label> labels, std::span<const Truth> truth);

/// Upper ends of the bands of horizontal range that are scored apart, metres; the first begins at
/// 0.
inline constexpr std::array<float, 4> range_bands = {10, 20, 40, 80};

/// Side of the cells of the bird's-eye view, metres. They cover the square out to the last band.
inline constexpr float cell_size = 0.5f;

/// One method's labels of one scan compared with the truth.
struct Score {
  Confusion points;                                      ///< over all points
  std::array<Confusion, range_bands.size()> by_range{};  ///< points of each band
  Confusion by_area;  ///< each cell counts once, divided among its points
};

/// What is true of each point of a scan, and where it counts. One per thread, used again: its
/// memory is kept.
class ScanTruth {
 public:
  /// `classes` holds one id per point of `cloud`.
  void set(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes);

  [[nodiscard]] std::span<const Truth> truth() const noexcept { return truth_; }

  /// Scores one label per point of that cloud.
  [[nodiscard]] Score score(std::span<const Label> labels) const noexcept;

 private:
  std::vector<Truth> truth_;
  std::vector<std::uint8_t> groups_;        // per point: band and truth
  std::vector<std::uint32_t> cells_;        // per point
  std::vector<std::uint32_t> cell_points_;  // per cell: scored points
  std::vector<float> shares_;               // per cell: what each of its points counts
};

/// Upper ends of the bands of horizontal range in which heights are judged, metres; the first
/// begins at 0.
inline constexpr std::array<float, 3> height_bands = {20, 40, 80};

/// How far a method's heights above the ground are from the truth, over some points of one scan.
/// An error is what the method says minus what is true, metres: above 0 where its ground lies too
/// low.
struct HeightErrors {
  std::size_t points = 0;  ///< whose true height is known
  std::size_t given = 0;   ///< of these, those for which the method has a height
  /// @name Over those with a height; 0 of none
  /// @{
  double median = 0;        ///< of the absolute error, metres: at least half do not exceed it
  double percentile95 = 0;  ///< the same for 95 % of the points
  double bias = 0;          ///< mean error, metres
  /// @}

  /// Share of the points for which the method has a height; none of no points.
  [[nodiscard]] std::optional<double> share() const noexcept {
    if (points == 0) return std::nullopt;
    return static_cast<double>(given) / static_cast<double>(points);
  }
};

/// The same over all points and in bands of range.
struct HeightErrorsByRange {
  HeightErrors all;  ///< at any range
  std::array<HeightErrors, height_bands.size()> by_range{};
};

/// One method's heights of one scan compared with the truth.
struct HeightScore {
  HeightErrorsByRange ground;  ///< true ground: where the surface was seen
  /// Every point, also those on what stands on the ground and hides it.
  HeightErrorsByRange everywhere;
};

/// Scores heights above the ground, one a point, NaN where the method has none. `true_ground` is
/// the z of the ground at each point, metres, NaN where not known; `truth` says which are ground.
HeightScore score_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground, std::span<const float> heights);

}  // namespace flagstone::eval

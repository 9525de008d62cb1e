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
/// Confusion matrix of labels and ground truth; section IV-B of the paper, equation (1). Counts are
/// points, or BEV cells that count once each. For moving points, read "moving" instead of "ground".
/// All metrics are ratios from 0 to 1, or NaN if they
/// are undefined. Without ground in the ground truth only the accuracy is defined; without points
/// labelled ground the precision is undefined.
struct Confusion {
  double true_positives = 0;
  double false_positives = 0;
  double false_negatives = 0;
  double true_negatives = 0;

  Confusion& operator+=(const Confusion& other) noexcept;

  /// Whether the ground truth contains ground.
  [[nodiscard]] bool has_ground() const noexcept { return true_positives + false_negatives > 0; }

  /// Number of scored points or cells.
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
  /// Intersection over union of labelled ground and ground truth.
  [[nodiscard]] double iou() const noexcept {
    if (!has_ground()) return undefined;
    return true_positives / (true_positives + false_positives + false_negatives);
  }

 private:
  static constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
};

/// "95.12" for a ratio of 0.9512, "n/a" for an undefined ratio.
std::string percent_text(double ratio);

/// "precision 95.12 %, recall 93.00 %, F1 94.05 %"; only the accuracy if the ground truth contains
/// no ground.
std::string scores_text(const Confusion& confusion);

/// Compares labels with the ground truth, one of each per point. All labels except ground count as
/// not ground. Ignored points are skipped.
Confusion compare(std::span<const Label> labels, std::span<const Truth> truth);

/// Upper ends of the bands of horizontal range with separate scores, metres; the first band begins
/// at 0.
inline constexpr std::array<float, 4> range_bands = {10, 20, 40, 80};

/// Index of the range band of a point; bands.size() beyond the last band and for non-finite points.
/// Counts band ends instead of branching, because branches would often be mispredicted.
template <std::size_t Count>
std::uint32_t band_of(Point p, const std::array<float, Count>& bands) {
  const float squared_range = p.x * p.x + p.y * p.y;
  std::uint32_t band = 0;
  for (const float end : bands) band += squared_range < end * end ? 0 : 1;
  return band;
}

/// Side of the cells of the bird's-eye view (BEV), metres. The cells cover the square up to the end
/// of the last band.
inline constexpr float cell_size = 0.5f;

/// Score of the labels of one method for one scan.
struct Score {
  Confusion points;                                      ///< over all points
  std::array<Confusion, range_bands.size()> by_range{};  ///< points in each band
  Confusion by_area;  ///< per BEV cell: each cell counts once, divided equally among its points
};

/// The ground truth of each point of a scan, with its range band and BEV cell. Reuses its memory.
/// Not thread-safe: use one instance per thread.
class ScanTruth {
 public:
  /// `classes` contains one id per point of `cloud`.
  void set(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes);

  [[nodiscard]] std::span<const Truth> truth() const noexcept { return truth_; }

  /// Scores labels, one per point of the cloud passed to set().
  [[nodiscard]] Score score(std::span<const Label> labels) const noexcept;

 private:
  std::vector<Truth> truth_;
  std::vector<std::uint8_t> groups_;        // per point: band and ground truth
  std::vector<std::uint32_t> cells_;        // per point: BEV cell
  std::vector<std::uint32_t> cell_points_;  // per cell: number of scored points
  std::vector<float> shares_;               // per cell: weight of each of its points
};

/// Upper ends of the bands of horizontal range in which heights are evaluated, metres; the first
/// band begins at 0.
inline constexpr std::array<float, 3> height_bands = {20, 40, 80};

/// Height errors of a method over a set of points of one scan. The error is the estimated height
/// minus the true height, metres. A positive error means that the estimated ground is too low.
struct HeightErrors {
  std::size_t points = 0;  ///< number of points with a known true height
  std::size_t given = 0;   ///< number of these for which the method provides a height
  /// @name Over the points with a height; 0 without such points
  /// @{
  double median = 0;        ///< of the absolute error, metres
  double percentile95 = 0;  ///< of the absolute error, metres
  double bias = 0;          ///< mean error, metres
  /// @}

  /// Fraction of the points for which the method provides a height; nullopt without points.
  [[nodiscard]] std::optional<double> share() const noexcept {
    if (points == 0) return std::nullopt;
    return static_cast<double>(given) / static_cast<double>(points);
  }
};

/// Height errors over all points and in range bands.
struct HeightErrorsByRange {
  HeightErrors all;  ///< points at any range
  std::array<HeightErrors, height_bands.size()> by_range{};
};

/// Height errors of one method for one scan.
struct HeightScore {
  HeightErrorsByRange ground;  ///< ground points in the ground truth
  /// All points, including points on objects that hide the ground.
  HeightErrorsByRange everywhere;
  /// Whether the sets of common points are set.
  bool has_common = false;
  /// The points of these sets for which every method with heights provides one.
  HeightErrorsByRange common_ground, common_everywhere;
};

/// Scores heights above the ground, one per point; NaN for points without a height. `true_ground`
/// is the z of the true ground at each point, metres, NaN if unknown. `truth` selects the ground
/// points.
HeightScore score_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground, std::span<const float> heights);

/// Sets the common points of `scores`, the scores of several methods for one scan, from the heights
/// of each method. Other parameters as score_heights().
void score_common_heights(CloudView cloud, std::span<const Truth> truth,
                          std::span<const float> true_ground,
                          std::span<const std::vector<float>> heights,
                          std::span<HeightScore* const> scores);

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "library/core/truth.hpp"

namespace flagstone::eval {

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

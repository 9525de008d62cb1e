// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "flagstone/baselines/ransac.hpp"
#include "lab/baselines/coordinates.hpp"
#include "lab/baselines/fitted_plane.hpp"

namespace flagstone::baselines {

/// k, section II-B: the minimum number of trials such that, with probability `confidence` (z), at
/// least one sample contains inliers only: (1 - w^3)^k <= 1 - z. `inlier_share` (w) is the fraction
/// of inliers, 0 to 1. At most `max_trials`.
int trials_needed(double inlier_share, double confidence, int max_trials) noexcept;

/// The plane through points i, j and k; nullopt if they are collinear.
std::optional<SinglePrecisionPlane> plane_through(const Coordinates& points, std::size_t i,
                                                  std::size_t j, std::size_t k) noexcept;

/// Number of points at most `distance` from the plane, metres, on either side.
std::size_t consensus_size(const Coordinates& points, const SinglePrecisionPlane& plane,
                           float distance) noexcept;

/// Result of the search.
struct RansacSearch {
  SinglePrecisionPlane plane;  ///< through the three points of the best sample
  std::size_t consensus = 0;   ///< number of inliers; 0 if there is no plane
  int trials = 0;              ///< number of trials
};

/// Draws samples until their number reaches trials_needed() for the largest consensus so far. Among
/// equal samples the first is used.
RansacSearch search_plane(const Coordinates& points, const RansacConfig& config) noexcept;

}  // namespace flagstone::baselines

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "flagstone/baselines/ransac.hpp"
#include "lab/baselines/coordinates.hpp"
#include "lab/baselines/fitted_plane.hpp"

namespace flagstone::baselines {

/// k, section II-B: the fewest trials that miss the `inlier_share` (w) of a scan in every sample
/// with a probability of at most 1 - `confidence` (z): (1 - w^3)^k <= 1 - z. At most `max_trials`.
int trials_needed(double inlier_share, double confidence, int max_trials) noexcept;

/// The plane through points i, j and k; none where they lie on a line.
std::optional<SinglePrecisionPlane> plane_through(const Coordinates& points, std::size_t i,
                                                  std::size_t j, std::size_t k) noexcept;

/// How many points lie at most `distance` from the plane, on either side.
std::size_t consensus_size(const Coordinates& points, const SinglePrecisionPlane& plane,
                           float distance) noexcept;

/// What the search came to.
struct RansacSearch {
  SinglePrecisionPlane plane;  ///< through the three points of the best sample
  std::size_t consensus = 0;   ///< points that agree with it; 0 where there is no plane
  int trials = 0;              ///< trials made
};

/// Draws samples until trials_needed for the largest consensus so far have been drawn; of equal
/// ones the first counts.
RansacSearch search_plane(const Coordinates& points, const RansacConfig& config) noexcept;

}  // namespace flagstone::baselines

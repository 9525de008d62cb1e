// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/ransac_search.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "library/core/random.hpp"

namespace flagstone::baselines {
namespace {

std::size_t draw_index(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

/// Draws three different indices below `count`, which must be at least 3.
std::array<std::size_t, 3> draw_sample(Random& random, std::size_t count) {
  const std::size_t i = draw_index(random, count);
  std::size_t j = i;
  while (j == i) j = draw_index(random, count);
  std::size_t k = i;
  while (k == i || k == j) k = draw_index(random, count);
  return {i, j, k};
}

}  // namespace

// Multiplies instead of taking logarithms, whose last bit differs between mathematical libraries
// and would change the number of trials and the labels.
int trials_needed(double inlier_share, double confidence, int max_trials) noexcept {
  const double sample_missed = 1 - inlier_share * inlier_share * inlier_share;
  double all_missed = 1;
  int trials = 0;
  while (trials < max_trials && all_missed > 1 - confidence) {
    all_missed *= sample_missed;
    ++trials;
  }
  return trials;
}

std::optional<SinglePrecisionPlane> plane_through(const Coordinates& points, std::size_t i,
                                                  std::size_t j, std::size_t k) noexcept {
  const Vector3 p = {points.x[i], points.y[i], points.z[i]};
  const Vector3 u = {points.x[j] - p[0], points.y[j] - p[1], points.z[j] - p[2]};
  const Vector3 v = {points.x[k] - p[0], points.y[k] - p[1], points.z[k] - p[2]};
  const Vector3 n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                     u[0] * v[1] - u[1] * v[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0)) return std::nullopt;
  return SinglePrecisionPlane{
      static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
      static_cast<float>(n[2] / length),
      static_cast<float>(-(n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / length)};
}

// This loop takes nearly all of the time. It uses packed floats and a 32-bit count so that the
// compiler can vectorise it.
std::size_t consensus_size(const Coordinates& points, const SinglePrecisionPlane& plane,
                           float distance) noexcept {
  const float* x = points.x.data();
  const float* y = points.y.data();
  const float* z = points.z.data();
  const SinglePrecisionPlane p = plane;
  std::uint32_t agree = 0;  // a scan has at most 2^32 - 1 points
  for (std::size_t i = 0; i < points.size(); ++i) {
    agree += std::abs(p.distance(x[i], y[i], z[i])) <= distance ? 1U : 0U;
  }
  return agree;
}

RansacSearch search_plane(const Coordinates& points, const RansacConfig& config) noexcept {
  RansacSearch best;
  if (points.size() < 3) return best;
  Random random(static_cast<std::uint64_t>(config.seed));
  int needed = config.max_trials;
  for (; best.trials < needed; ++best.trials) {
    const auto [i, j, k] = draw_sample(random, points.size());
    const std::optional<SinglePrecisionPlane> plane = plane_through(points, i, j, k);
    if (!plane) continue;
    const std::size_t consensus = consensus_size(points, *plane, config.distance_threshold);
    if (consensus <= best.consensus) continue;
    best.plane = *plane;
    best.consensus = consensus;
    const double share = static_cast<double>(consensus) / static_cast<double>(points.size());
    needed = trials_needed(share, config.confidence, config.max_trials);
  }
  return best;
}

}  // namespace flagstone::baselines

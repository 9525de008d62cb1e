// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "mount/ground_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone::mount {
namespace {

/// Between directions of the first look: tangent of 5 degrees, which is half a metre of height 6 m
/// away, as much as a level is thick.
constexpr float direction_step = 0.0875f;

/// Metres a level is thick, in two slices; both overlap with those above and below.
constexpr float slice = 0.25f;

/// What lies below a level counts against it so many times as what lies in it counts for it.
constexpr float cost_below = 2;

/// Points looked at for every direction; all of them for the refinement of the best few.
constexpr std::size_t few = 2048;
constexpr std::size_t most_candidates = 4;

/// The refinement believes points within these distances of the plane, one round after the other,
/// metres, and half as far above it once the plane is nearly there: what stands on the ground is
/// always above it.
constexpr std::array<float, 6> gates = {0.6f, 0.45f, 0.3f, 0.25f, 0.2f, 0.2f};
constexpr float gate_growth = 0.015f;  // metres a metre of range
constexpr std::size_t one_sided_from = 2;

/// A straight line of points, or a patch far off to one side, does not tell the slope below the
/// vehicle. As if so many square metres a unit of weight were seen level.
constexpr double level_prior = 0.3;

/// z = a * x + b * y + c by weighted least squares; sums in double precision.
struct PlaneSums {
  double w = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void add(double weight, double px, double py, double pz) noexcept {
    w += weight;
    x += weight * px;
    y += weight * py;
    z += weight * pz;
    xx += weight * px * px;
    xy += weight * px * py;
    yy += weight * py * py;
    xz += weight * px * pz;
    yz += weight * py * pz;
  }
  struct Solution {
    float a, b, c;
  };
  [[nodiscard]] std::optional<Solution> solve() const noexcept {
    if (!(w > 0)) return {};
    const double mx = x / w;
    const double my = y / w;
    const double mz = z / w;
    const double cxx = xx / w - mx * mx + level_prior;
    const double cyy = yy / w - my * my + level_prior;
    const double cxy = xy / w - mx * my;
    const double cxz = xz / w - mx * mz;
    const double cyz = yz / w - my * mz;
    const double determinant = cxx * cyy - cxy * cxy;  // at least level_prior^2
    const double a = (cxz * cyy - cyz * cxy) / determinant;
    const double b = (cyz * cxx - cxz * cxy) / determinant;
    return Solution{static_cast<float>(a), static_cast<float>(b),
                    static_cast<float>(mz - a * mx - b * my)};
  }
};

float gate_at(float gate, const NearPoint& p) noexcept {
  return gate + gate_growth * (std::abs(p.x) + std::abs(p.y));
}

}  // namespace

PlaneSearch::PlaneSearch(const MountLimits& limits, bool looks_for_tilt)
    : limits_(limits), looks_for_tilt_(looks_for_tilt) {
  const auto tangent =
      looks_for_tilt ? std::tan(double{limits.most_tilt} * std::numbers::pi / 180) : 0.0;
  const int steps = static_cast<int>(std::ceil(tangent / double{direction_step}));
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      if (i * i + j * j > steps * steps) continue;
      directions_.push_back(unit(
          {direction_step * static_cast<float>(i), direction_step * static_cast<float>(j), 1}));
    }
  }
  few_.resize(few);
  levels_.resize(static_cast<std::size_t>(std::ceil((limits.most_height + 1) / slice)) + 2);
  best_.reserve(most_candidates + 1);
}

PlaneSearch::Candidate PlaneSearch::level_along(std::span<const NearPoint> points,
                                                const Vector3f& up) noexcept {
  // Slices are counted upward from below the lowest ground there can be; what is lower still is in
  // the first.
  const auto count = levels_.size();
  const float lowest = -static_cast<float>(count - 1) * slice;
  std::ranges::fill(levels_, 0.0f);
  for (const NearPoint& p : points) {
    const float z = up[0] * p.x + up[1] * p.y + up[2] * p.z;
    if (z >= 0) continue;
    const auto index = static_cast<std::size_t>(std::max((z - lowest) / slice, 0.0f));
    levels_[std::min(index, count - 1)] += p.weight;
  }
  Candidate best;
  float below = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const float height =
        -(lowest + static_cast<float>(i + 1) * slice);  // the middle of i and i + 1
    const float score = levels_[i] + levels_[i + 1] - cost_below * below;
    below += levels_[i - 1];
    if (height + slice < limits_.least_height || height - slice > limits_.most_height) continue;
    if (score > best.score) best = {.plane = {up, height}, .score = score};
  }
  return best;
}

void PlaneSearch::rank_directions(std::span<const NearPoint> points) noexcept {
  best_.clear();
  std::span<const NearPoint> looked_at = points;
  if (directions_.size() > 1 && points.size() > few) {
    for (std::size_t i = 0; i < few; ++i) few_[i] = points[i * points.size() / few];
    looked_at = few_;
  }
  for (const Vector3f& up : directions_) {
    const Candidate candidate = level_along(looked_at, up);
    if (!(candidate.score > 0)) continue;
    const auto place =
        std::ranges::upper_bound(best_, candidate.score, std::ranges::greater(), &Candidate::score);
    best_.insert(place, candidate);
    if (best_.size() > most_candidates) best_.pop_back();
  }
}

float PlaneSearch::score(std::span<const NearPoint> points,
                         const GroundPlane& plane) const noexcept {
  float in = 0;
  float below = 0;
  for (const NearPoint& p : points) {
    const float z = plane.up[0] * p.x + plane.up[1] * p.y + plane.up[2] * p.z + plane.height;
    const float gate = gate_at(gates.back(), p);
    in += std::abs(z) < gate ? p.weight : 0;
    below += z < -2 * gate ? p.weight : 0;
  }
  return in - cost_below * below;
}

namespace {

GroundPlane refined(std::span<const NearPoint> points, GroundPlane plane) noexcept {
  for (std::size_t round = 0; round < gates.size(); ++round) {
    const Turn turn = turn_to_z(plane.up);
    PlaneSums sums;
    for (const NearPoint& p : points) {
      const float z = turn.z[0] * p.x + turn.z[1] * p.y + turn.z[2] * p.z + plane.height;
      const float gate = gate_at(gates[round], p);
      const float reach = z > 0 && round >= one_sided_from ? gate / 2 : gate;
      const float relative = z / reach;
      const float left = 1 - relative * relative;
      if (!(left > 0)) continue;
      const Vector3f place = {p.x, p.y, p.z};
      sums.add(double{p.weight} * left * left, dot(turn.x, place), dot(turn.y, place), z);
    }
    const auto solution = sums.solve();
    if (!solution) break;
    const auto [a, b, c] = *solution;
    // In the turned frame the plane is z = a x + b y + c - height.
    const float shorter = 1 / std::sqrt(1 + a * a + b * b);
    plane.up = unit(turn.undo({-a * shorter, -b * shorter, shorter}));
    plane.height = (plane.height - c) * shorter;
  }
  return plane;
}

}  // namespace

std::optional<GroundPlane> PlaneSearch::find(std::span<const NearPoint> points) noexcept {
  rank_directions(points);
  std::optional<GroundPlane> best;
  float best_score = 0;
  for (const Candidate& candidate : best_) {
    const GroundPlane plane = refined(points, candidate.plane);
    const float reached = score(points, plane);
    if (best && reached <= best_score) continue;
    best = plane;
    best_score = reached;
  }
  return best;
}

}  // namespace flagstone::mount

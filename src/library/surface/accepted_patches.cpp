// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/accepted_patches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/accepted_patches.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_SURFACE_ACCEPTED_PATCHES_ONCE
#define FLAGSTONE_SURFACE_ACCEPTED_PATCHES_ONCE
namespace flagstone::surface {

/// Columns of accepted patches, each padded to a multiple of 16 by patches that are far away.
struct PatchColumns {
  const float *x, *y, *z, *slope_x, *slope_y, *trust;
  std::size_t places;
};

/// Sums over neighbours.
struct NeighbourSums {
  float trust;
  float continued;  ///< trust times expected height, by the neighbours' planes
  float curved;     ///< the same by curves
  float least_squared_distance;
};

/// Slopes are believed to three quarters.
inline constexpr float believed_slope = 0.75f;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// The sum of sixteen lanes is always that of halves: l + (l + 8), then + 4, + 2, + 1.
float sum_of_lanes(const std::array<float, lanes>& values) {
  std::array<float, lanes> sums = values;
  for (std::size_t half = lanes / 2; half > 0; half /= 2) {
    for (std::size_t lane = 0; lane < half; ++lane) sums[lane] += sums[lane + half];
  }
  return sums[0];
}

void sum_neighbours(const PatchColumns& columns, const FittedPatch& patch, float squared_radius,
                    NeighbourSums& sums) {
  const FloatTag d;
  HWY_ALIGN std::array<float, lanes> trusts;
  HWY_ALIGN std::array<float, lanes> continueds;
  HWY_ALIGN std::array<float, lanes> curveds;
  HWY_ALIGN std::array<float, lanes> nearests;
  const FloatVector px = hn::Set(d, patch.x);
  const FloatVector py = hn::Set(d, patch.y);
  const FloatVector one = hn::Set(d, 1.0f);
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector trust = hn::Zero(d);
    FloatVector continued = hn::Zero(d);
    FloatVector curved = hn::Zero(d);
    FloatVector nearest = hn::Set(d, std::numeric_limits<float>::max());
    for (std::size_t i = lane; i < columns.places; i += lanes) {
      const FloatVector dx = hn::Sub(px, hn::Load(d, columns.x + i));
      const FloatVector dy = hn::Sub(py, hn::Load(d, columns.y + i));
      const FloatVector squared = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
      const auto near = hn::Le(squared, hn::Set(d, squared_radius));
      if (hn::AllFalse(d, near)) continue;
      const FloatVector nearness = hn::Add(one, squared);
      const FloatVector weight = hn::IfThenElseZero(
          near, hn::Div(hn::Load(d, columns.trust + i), hn::Mul(nearness, nearness)));
      const FloatVector theirs = hn::Add(hn::Mul(dx, hn::Load(d, columns.slope_x + i)),
                                         hn::Mul(dy, hn::Load(d, columns.slope_y + i)));
      const FloatVector its =
          hn::Add(hn::Mul(dx, hn::Set(d, patch.slope_x)), hn::Mul(dy, hn::Set(d, patch.slope_y)));
      const FloatVector z = hn::Load(d, columns.z + i);
      const FloatVector believed = hn::Set(d, believed_slope);
      const FloatVector straight = hn::Add(z, hn::Mul(believed, theirs));
      const FloatVector bent =
          hn::Add(z, hn::Mul(hn::Mul(hn::Set(d, 0.5f), believed), hn::Add(theirs, its)));
      trust = hn::Add(trust, weight);
      continued = hn::Add(continued, hn::Mul(weight, straight));
      curved = hn::Add(curved, hn::Mul(weight, bent));
      nearest = hn::Min(nearest, squared);
    }
    hn::Store(trust, d, trusts.data() + lane);
    hn::Store(continued, d, continueds.data() + lane);
    hn::Store(curved, d, curveds.data() + lane);
    hn::Store(nearest, d, nearests.data() + lane);
  }
  sums = {.trust = sum_of_lanes(trusts),
          .continued = sum_of_lanes(continueds),
          .curved = sum_of_lanes(curveds),
          .least_squared_distance = std::ranges::min(nearests)};
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(sum_neighbours);

constexpr std::size_t column_count = 6;
constexpr float far_away = 1e15f;  // its square is still a number

}  // namespace

void AcceptedPatches::reserve(std::size_t count) {
  capacity_ = (count + 15) / 16 * 16;
  columns_.reserve(column_count * capacity_);
}

void AcceptedPatches::add(const FittedPatch& patch) noexcept {
  float* const x = columns_.data();
  const std::array<float, column_count> row = {
      patch.x, patch.y, patch.z, patch.slope_x, patch.slope_y, patch.points / (patch.points + 20)};
  if (count_ % 16 == 0) {
    for (std::size_t column = 0; column < column_count; ++column) {
      std::fill_n(x + column * capacity_ + count_, 16, column < 2 ? far_away : 0.0f);
    }
  }
  for (std::size_t column = 0; column < column_count; ++column) {
    x[column * capacity_ + count_] = row[column];
  }
  ++count_;
}

AcceptedPatches::Fit AcceptedPatches::fit(const FittedPatch& patch, float radius) const noexcept {
  const float* const x = columns_.data();
  const PatchColumns columns{.x = x,
                             .y = x + capacity_,
                             .z = x + 2 * capacity_,
                             .slope_x = x + 3 * capacity_,
                             .slope_y = x + 4 * capacity_,
                             .trust = x + 5 * capacity_,
                             .places = (count_ + 15) / 16 * 16};
  NeighbourSums sums{};
  HWY_DYNAMIC_DISPATCH(sum_neighbours)(columns, patch, radius * radius, sums);
  if (sums.trust <= 0) return {.has_neighbour = false, .distance = 0, .step = 0};
  const float above_straight = patch.z - sums.continued / sums.trust;
  const float above_curved = patch.z - sums.curved / sums.trust;
  return {
      .has_neighbour = true,
      .distance = std::sqrt(sums.least_squared_distance),
      .step = std::abs(above_curved) < std::abs(above_straight) ? above_curved : above_straight};
}

}  // namespace flagstone::surface
#endif

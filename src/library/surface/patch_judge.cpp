// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/patch_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "library/core/mounting_height.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/patch_judge.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_SURFACE_PATCH_JUDGE_ONCE
#define FLAGSTONE_SURFACE_PATCH_JUDGE_ONCE
namespace flagstone::surface {

/// Columns of accepted patches, each padded to a multiple of 16 with patches at a very large
/// distance.
struct PatchColumns {
  const float *x, *y, *z, *slope_x, *slope_y, *trust;
  std::size_t places;
};

/// Sums over neighbours.
struct NeighbourSums {
  float trust;
  float continued;  ///< weight times height predicted by the neighbours' planes
  float curved;     ///< weight times height predicted by curves
  float least_squared_distance;
};

/// Weights of neighbours that speak for and against a patch.
struct Votes {
  float agree;
  float lower;  ///< they predict less height than the patch has
};

/// A neighbour agrees with a patch up to this height difference, metres, and this much more per
/// metre of distance.
inline constexpr float agreement = 0.4f;
inline constexpr float agreement_per_metre = 0.05f;

/// Factor by which predictions reduce slopes.
inline constexpr float slope_factor = 0.75f;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

void count_bins(const plane_fits::BinBatch& batch, const PlaneBatch& planes,
                std::array<SlabCounts, batch_size>& counts) {
  const FloatTag d;
  for (std::size_t bin = 0; bin < batch.count(); ++bin) {
    const FloatVector nx = hn::Set(d, static_cast<float>(planes.normal[0][bin]));
    const FloatVector ny = hn::Set(d, static_cast<float>(planes.normal[1][bin]));
    const FloatVector nz = hn::Set(d, static_cast<float>(planes.normal[2][bin]));
    const FloatVector offset = hn::Set(d, static_cast<float>(planes.d[bin]));
    const float* HWY_RESTRICT x = batch.x(bin);
    const float* HWY_RESTRICT y = batch.y(bin);
    const float* HWY_RESTRICT z = batch.z(bin);
    const std::size_t places = batch.places(bin);
    std::size_t within = 0;
    std::size_t above = 0;
    for (std::size_t i = 0; i < places; i += hn::Lanes(d)) {
      // Infinite in slots without a point, or NaN if the plane is vertical.
      const FloatVector distance =
          hn::Add(hn::Add(hn::Add(hn::Mul(nx, hn::Load(d, x + i)), hn::Mul(ny, hn::Load(d, y + i))),
                          hn::Mul(nz, hn::Load(d, z + i))),
                  offset);
      within += hn::CountTrue(d, hn::Lt(hn::Abs(distance), hn::Set(d, 0.125f)));
      above += hn::CountTrue(
          d, hn::And(hn::Gt(distance, hn::Set(d, 0.1875f)), hn::Lt(distance, hn::Set(d, 0.8875f))));
    }
    counts[bin] = {.within = static_cast<std::uint32_t>(within),
                   .above = static_cast<std::uint32_t>(above)};
  }
}

/// Adds sixteen lanes in the same order for every vector length: l + (l + 8), then + 4, + 2, + 1.
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
  HWY_ALIGN std::array<float, lanes> weight_sums;
  HWY_ALIGN std::array<float, lanes> linear_sums;
  HWY_ALIGN std::array<float, lanes> curved_sums;
  HWY_ALIGN std::array<float, lanes> min_squared_distances;
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
      const FloatVector neighbour_rise = hn::Add(hn::Mul(dx, hn::Load(d, columns.slope_x + i)),
                                                 hn::Mul(dy, hn::Load(d, columns.slope_y + i)));
      const FloatVector own_rise =
          hn::Add(hn::Mul(dx, hn::Set(d, patch.slope_x)), hn::Mul(dy, hn::Set(d, patch.slope_y)));
      const FloatVector z = hn::Load(d, columns.z + i);
      const FloatVector factor = hn::Set(d, slope_factor);
      const FloatVector straight = hn::Add(z, hn::Mul(factor, neighbour_rise));
      const FloatVector bent =
          hn::Add(z, hn::Mul(hn::Mul(hn::Set(d, 0.5f), factor), hn::Add(neighbour_rise, own_rise)));
      trust = hn::Add(trust, weight);
      continued = hn::Add(continued, hn::Mul(weight, straight));
      curved = hn::Add(curved, hn::Mul(weight, bent));
      nearest = hn::Min(nearest, squared);
    }
    hn::Store(trust, d, weight_sums.data() + lane);
    hn::Store(continued, d, linear_sums.data() + lane);
    hn::Store(curved, d, curved_sums.data() + lane);
    hn::Store(nearest, d, min_squared_distances.data() + lane);
  }
  sums = {.trust = sum_of_lanes(weight_sums),
          .continued = sum_of_lanes(linear_sums),
          .curved = sum_of_lanes(curved_sums),
          .least_squared_distance = std::ranges::min(min_squared_distances)};
}

void count_votes(const PatchColumns& columns, const FittedPatch& patch, float squared_radius,
                 Votes& votes) {
  const FloatTag d;
  HWY_ALIGN std::array<float, lanes> agree_sums;
  HWY_ALIGN std::array<float, lanes> lower_sums;
  const FloatVector px = hn::Set(d, patch.x);
  const FloatVector py = hn::Set(d, patch.y);
  const FloatVector pz = hn::Set(d, patch.z);
  const FloatVector one = hn::Set(d, 1.0f);
  const FloatVector zero = hn::Zero(d);
  const FloatVector factor = hn::Set(d, slope_factor);
  const FloatVector half = hn::Set(d, 0.5f);
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector agree = zero;
    FloatVector lower = zero;
    for (std::size_t i = lane; i < columns.places; i += lanes) {
      const FloatVector dx = hn::Sub(px, hn::Load(d, columns.x + i));
      const FloatVector dy = hn::Sub(py, hn::Load(d, columns.y + i));
      const FloatVector squared = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
      const auto near = hn::And(hn::Le(squared, hn::Set(d, squared_radius)), hn::Gt(squared, zero));
      if (hn::AllFalse(d, near)) continue;
      const FloatVector weight =
          hn::IfThenElseZero(near, hn::Div(hn::Load(d, columns.trust + i), hn::Add(one, squared)));
      const FloatVector neighbour_rise = hn::Add(hn::Mul(dx, hn::Load(d, columns.slope_x + i)),
                                                 hn::Mul(dy, hn::Load(d, columns.slope_y + i)));
      const FloatVector own_rise =
          hn::Add(hn::Mul(dx, hn::Set(d, patch.slope_x)), hn::Mul(dy, hn::Set(d, patch.slope_y)));
      const FloatVector above = hn::Sub(pz, hn::Load(d, columns.z + i));
      const FloatVector above_straight = hn::Sub(above, hn::Mul(factor, neighbour_rise));
      const FloatVector above_curved =
          hn::Sub(above, hn::Mul(hn::Mul(half, factor), hn::Add(neighbour_rise, own_rise)));
      const auto curved = hn::Lt(hn::Abs(above_curved), hn::Abs(above_straight));
      const FloatVector step = hn::IfThenElse(curved, above_curved, above_straight);
      const FloatVector allowed = hn::Add(
          hn::Set(d, agreement), hn::Mul(hn::Set(d, agreement_per_metre), hn::Sqrt(squared)));
      lower = hn::Add(lower, hn::IfThenElseZero(hn::Gt(step, allowed), weight));
      agree = hn::Add(agree, hn::IfThenElseZero(hn::Le(hn::Abs(step), allowed), weight));
    }
    hn::Store(agree, d, agree_sums.data() + lane);
    hn::Store(lower, d, lower_sums.data() + lane);
  }
  votes = {.agree = sum_of_lanes(agree_sums), .lower = sum_of_lanes(lower_sums)};
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(count_bins);
HWY_EXPORT(sum_neighbours);
HWY_EXPORT(count_votes);

/// Planes through fewer points are not evaluated.
constexpr double fewest_points = 5;

/// Minimum z of a normal for any setting: the slope of a steeper plane is too uncertain.
constexpr double least_normal_z = 0.05;

/// The sensor may be at most this far below a plane, as a fraction of the range: its slope is
/// uncertain.
constexpr double least_grazing_slope = -0.02;

/// Patches with hardly a point above them may be steeper than others: banks, but not bushes.
/// Windows of cars are steep, too, so the limit for their step is lower, and they need a neighbour.
constexpr double steeper = 8.7;  // degrees
constexpr double clear_ratio = 0.05;
constexpr float steep_step = 0.5f;
constexpr float steep_step_per_metre = 0.05f;

/// Additional step that is allowed downwards, metres.
constexpr float extra_step_down = 0.5f;

/// The allowed step grows with the distance to the nearest patch up to this distance, metres.
constexpr float longest_gap = 15;

/// Neighbours lie within this fraction of the range, but at least within `neighbour_metres`.
constexpr float neighbour_share = 0.5f;
constexpr float neighbour_metres = 8;

float neighbour_radius(const FittedPatch& patch) {
  const float range = std::sqrt(patch.x * patch.x + patch.y * patch.y);
  return std::max(neighbour_metres, neighbour_share * range);
}

/// A patch is not ground if lower neighbours weigh more than this many times those that agree.
constexpr float contradiction = 1.5f;

constexpr std::size_t column_count = 6;
constexpr float far_away = 1e15f;  // its square is finite

double normal_z_at(double upright_angle) {
  return std::max(least_normal_z, std::sin(upright_angle * std::numbers::pi / 180));
}

Verdict is_within(float step, float up, float down) {
  return step <= up && step >= -down ? Verdict::ground : Verdict::off_surface;
}

}  // namespace

std::array<SlabCounts, batch_size> count_slabs(const plane_fits::BinBatch& batch,
                                               const PlaneBatch& planes) noexcept {
  std::array<SlabCounts, batch_size> counts{};
  HWY_DYNAMIC_DISPATCH(count_bins)(batch, planes, counts);
  return counts;
}

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

PatchColumns AcceptedPatches::columns() const noexcept {
  const float* const x = columns_.data();
  return {.x = x,
          .y = x + capacity_,
          .z = x + 2 * capacity_,
          .slope_x = x + 3 * capacity_,
          .slope_y = x + 4 * capacity_,
          .trust = x + 5 * capacity_,
          .places = (count_ + 15) / 16 * 16};
}

bool AcceptedPatches::contradict(const FittedPatch& patch, float radius) const noexcept {
  Votes votes{};
  HWY_DYNAMIC_DISPATCH(count_votes)(columns(), patch, radius * radius, votes);
  return votes.lower > contradiction * votes.agree;
}

AcceptedPatches::Fit AcceptedPatches::fit(const FittedPatch& patch, float radius) const noexcept {
  NeighbourSums sums{};
  HWY_DYNAMIC_DISPATCH(sum_neighbours)(columns(), patch, radius * radius, sums);
  if (sums.trust <= 0) return {.has_neighbour = false, .distance = 0, .step = 0};
  const float above_straight = patch.z - sums.continued / sums.trust;
  const float above_curved = patch.z - sums.curved / sums.trust;
  return {
      .has_neighbour = true,
      .distance = std::sqrt(sums.least_squared_distance),
      .step = std::abs(above_curved) < std::abs(above_straight) ? above_curved : above_straight};
}

PatchJudge::PatchJudge(const SurfaceConfig& config)
    : least_normal_z_(normal_z_at(config.acceptance.upright_angle)),
      least_clear_normal_z_(normal_z_at(config.acceptance.upright_angle - steeper)),
      max_clutter_ratio_(config.acceptance.max_clutter_ratio),
      sensor_height_(config.sensor_height),
      height_(config.acceptance.max_height),
      rise_(config.acceptance.max_slope),
      step_(config.acceptance.max_step),
      step_growth_(config.acceptance.max_step_per_metre) {}

Verdict PatchJudge::judge_alone(const Plane& plane, const SlabCounts& counts) const noexcept {
  if (plane.count < fewest_points) return Verdict::no_plane;
  if (plane.normal[2] < least_clear_normal_z_) return Verdict::not_upright;
  if (plane.normal[2] < least_normal_z_ && counts.above > clear_ratio * counts.within) {
    return Verdict::not_upright;
  }
  if (counts.above > max_clutter_ratio_ * counts.within) return Verdict::mixed;
  const double range = std::sqrt(plane.mean[0] * plane.mean[0] + plane.mean[1] * plane.mean[1]);
  if (plane.mean[2] > -double{sensor_height_} + std::max(height_, rise_ * range))
    return Verdict::too_high;
  // The sensor sees ground only from its upper side, but ceilings and bridges from below.
  const double sensor_above_plane =
      static_cast<double>(sensor_z(sensor_height_)) + plane.d / plane.normal[2];
  if (sensor_above_plane < least_grazing_slope * range) return Verdict::too_high;
  return Verdict::ground;
}

float PatchJudge::allowed_step(float distance) const noexcept {
  return step_ + step_growth_ * std::min(distance, longest_gap);
}

Verdict PatchJudge::judge_step(const FittedPatch& patch,
                               const AcceptedPatches& nearer) const noexcept {
  const AcceptedPatches::Fit fit = nearer.fit(patch, neighbour_radius(patch));
  const float squared_steepness =  // 1 / n_z^2
      1 + patch.slope_x * patch.slope_x + patch.slope_y * patch.slope_y;
  if (squared_steepness * static_cast<float>(least_normal_z_ * least_normal_z_) > 1) {
    const float allowed = steep_step + steep_step_per_metre * fit.distance;
    return fit.has_neighbour ? is_within(fit.step, allowed, allowed) : Verdict::off_surface;
  }
  if (fit.has_neighbour) {
    const float allowed = allowed_step(fit.distance);
    return is_within(fit.step, allowed, allowed + extra_step_down);
  }
  // Level ground continues from below the sensor, or rises in a curve. It can fall unseen, but a
  // higher patch is more likely the roof of a car.
  const float above_level = patch.z + sensor_height_;
  const float above_curved =
      above_level - slope_factor / 2 * (patch.x * patch.slope_x + patch.y * patch.slope_y);
  const float range = std::sqrt(patch.x * patch.x + patch.y * patch.y);
  const float step = std::abs(above_curved) < std::abs(above_level) ? above_curved : above_level;
  return is_within(step, step_, allowed_step(range) + extra_step_down);
}

Verdict PatchJudge::judge_among(const FittedPatch& patch,
                                const AcceptedPatches& accepted) const noexcept {
  return accepted.contradict(patch, neighbour_radius(patch)) ? Verdict::off_surface
                                                             : Verdict::ground;
}

}  // namespace flagstone::surface
#endif

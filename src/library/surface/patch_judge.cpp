// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/patch_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flagstone::surface {
namespace {

/// A plane through fewer points says nothing.
constexpr double fewest_points = 5;

/// Patches nearer to upright walls have no slope to speak of, whatever the setting: z of their
/// normal.
constexpr double least_normal_z = 0.05;

/// How much farther below what is expected than above it a patch may lie, metres.
constexpr float extra_step_down = 0.5f;

/// Steps grow with the distance to the nearest patch up to here, metres.
constexpr float longest_gap = 15;

/// Patches within this share of the range are asked, and all within `fewest_metres`.
constexpr float neighbour_share = 0.5f;
constexpr float neighbour_metres = 8;

}  // namespace

PatchJudge::PatchJudge(const SurfaceConfig& config)
    : least_normal_z_(std::max(least_normal_z,
                               std::sin(config.acceptance.upright_angle * std::numbers::pi / 180))),
      max_clutter_ratio_(config.acceptance.max_clutter_ratio),
      sensor_height_(config.sensor_height),
      height_(config.acceptance.max_height),
      rise_(config.acceptance.max_slope),
      step_(config.acceptance.max_step),
      step_growth_(config.acceptance.max_step_per_metre) {}

Verdict PatchJudge::judge_alone(const Plane& plane, const SlabCounts& counts) const noexcept {
  if (plane.count < fewest_points) return Verdict::no_plane;
  if (plane.normal[2] < least_normal_z_) return Verdict::not_upright;
  if (counts.above > max_clutter_ratio_ * counts.within) return Verdict::mixed;
  const double range = std::sqrt(plane.mean[0] * plane.mean[0] + plane.mean[1] * plane.mean[1]);
  if (plane.mean[2] > -sensor_height_ + std::max(height_, rise_ * range)) return Verdict::too_high;
  return Verdict::ground;
}

Verdict PatchJudge::judge_step(const FittedPatch& patch,
                               const AcceptedPatches& nearer) const noexcept {
  const float range = std::sqrt(patch.x * patch.x + patch.y * patch.y);
  AcceptedPatches::Fit fit = nearer.fit(patch, std::max(neighbour_metres, neighbour_share * range));
  if (!fit.has_neighbour) {
    fit = {.has_neighbour = false,
           .distance = range,
           .step = patch.z + static_cast<float>(sensor_height_)};
  }
  const float allowed = step_ + step_growth_ * std::min(fit.distance, longest_gap);
  return fit.step <= allowed && fit.step >= -(allowed + extra_step_down) ? Verdict::ground
                                                                         : Verdict::off_surface;
}

}  // namespace flagstone::surface

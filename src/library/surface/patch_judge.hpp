// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/patch.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/buffer.hpp"
#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::surface {

/// Numbers of points of a patch in its plane and just above the plane.
struct SlabCounts {
  std::uint32_t within;  ///< less than 12.5 cm from the plane
  std::uint32_t above;   ///< more than 18.75 and less than 88.75 cm above it
};

/// Counts the points in and above the plane n . p + d = 0 of each patch of a batch, with p in the
/// coordinates of the batch.
std::array<SlabCounts, batch_size> count_slabs(const plane_fits::BinBatch& batch,
                                               const PlaneBatch& planes) noexcept;

/// A fitted patch as its neighbours use it: a point of its plane and the slope of the plane.
struct FittedPatch {
  float x, y, z;           ///< mean of its ground set, metres
  float slope_x, slope_y;  ///< m/m
  float points;            ///< number of points in its ground set

  /// `plane` must not be vertical.
  static FittedPatch of(const Plane& plane) noexcept {
    return {.x = static_cast<float>(plane.mean[0]),
            .y = static_cast<float>(plane.mean[1]),
            .z = static_cast<float>(plane.mean[2]),
            .slope_x = static_cast<float>(-plane.normal[0] / plane.normal[2]),
            .slope_y = static_cast<float>(-plane.normal[1] / plane.normal[2]),
            .points = static_cast<float>(plane.count)};
  }
};

struct PatchColumns;

/// The patches accepted as ground so far, and the heights that they predict.
class AcceptedPatches {
 public:
  /// Reserves memory for `count` patches; may throw std::bad_alloc.
  void reserve(std::size_t count);

  void clear() noexcept { count_ = 0; }
  void add(const FittedPatch& patch) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// How a patch fits the patches accepted within `radius` of its mean.
  struct Fit {
    bool has_neighbour;
    float distance;  ///< to the nearest neighbour, metres
    float step;      ///< height of the patch above the prediction, metres
  };

  /// Compares the height of `patch` with two predictions and returns the smaller step. One is the
  /// weighted mean height of the neighbours' planes at the patch, with their slopes reduced to
  /// three quarters. The other follows a curve from the slope of a neighbour to the slope of the
  /// patch, so that the ground continues at the base of a bank.
  [[nodiscard]] Fit fit(const FittedPatch& patch, float radius) const noexcept;

  /// True if the patches within `radius` show that `patch` is not ground but on top of something:
  /// those that predict less height than it has weigh more than 1.5 times those that agree with it.
  /// Patches with the same mean do not count, so that `patch` can be one of them.
  [[nodiscard]] bool contradict(const FittedPatch& patch, float radius) const noexcept;

 private:
  [[nodiscard]] PatchColumns columns() const noexcept;

  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
  Buffer<float> columns_;  ///< x, y, z, slope_x, slope_y, trust, one column after the other
};

/// Decides which patches are ground.
class PatchJudge {
 public:
  explicit PatchJudge(const SurfaceConfig& config);

  /// Evaluates a patch without its neighbours: number of points, uprightness, clutter ratio,
  /// maximum height, and whether the sensor is above the plane. `plane` is in the sensor frame.
  [[nodiscard]] Verdict judge_alone(const Plane& plane, const SlabCounts& counts) const noexcept;

  /// Compares a patch with the height that accepted patches nearer to the sensor predict, or with
  /// -h_s if it has no neighbour; it may then be at most `max_step` higher. Returns `ground` or
  /// `off_surface`.
  [[nodiscard]] Verdict judge_step(const FittedPatch& patch,
                                   const AcceptedPatches& nearer) const noexcept;

  /// Compares an accepted patch with all accepted patches around it, nearer and farther. Returns
  /// `ground` or `off_surface`.
  [[nodiscard]] Verdict judge_among(const FittedPatch& patch,
                                    const AcceptedPatches& accepted) const noexcept;

 private:
  /// Allowed step at a distance from the nearest neighbour.
  [[nodiscard]] float allowed_step(float distance) const noexcept;

  double least_normal_z_;
  double least_clear_normal_z_;  ///< of patches with hardly a point above them
  double max_clutter_ratio_;
  float sensor_height_;
  double height_;
  double rise_;
  float step_;
  float step_growth_;
};

}  // namespace flagstone::surface

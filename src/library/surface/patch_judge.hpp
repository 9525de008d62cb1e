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

/// How many of a patch's points lie in its plane and just above it.
struct SlabCounts {
  std::uint32_t within;  ///< less than 12.5 cm from the plane
  std::uint32_t above;   ///< more than 18.75 and less than 88.75 cm above it
};

/// For each patch of a batch the points in and above a plane n . p + d = 0, p as the batch has it.
std::array<SlabCounts, batch_size> count_slabs(const plane_fits::BinBatch& batch,
                                               const PlaneBatch& planes) noexcept;

/// A patch as seen by its neighbours: a point of its plane and how it rises from there.
struct FittedPatch {
  float x, y, z;           ///< mean of its ground set, metres
  float slope_x, slope_y;  ///< m/m
  float points;            ///< in its ground set

  /// `plane` is upright.
  static FittedPatch of(const Plane& plane) noexcept {
    return {.x = static_cast<float>(plane.mean[0]),
            .y = static_cast<float>(plane.mean[1]),
            .z = static_cast<float>(plane.mean[2]),
            .slope_x = static_cast<float>(-plane.normal[0] / plane.normal[2]),
            .slope_y = static_cast<float>(-plane.normal[1] / plane.normal[2]),
            .points = static_cast<float>(plane.count)};
  }
};

/// The patches found to be ground so far, and what they let expect elsewhere.
class AcceptedPatches {
 public:
  /// Makes room for `count` patches; may throw std::bad_alloc.
  void reserve(std::size_t count);

  void clear() noexcept { count_ = 0; }
  void add(const FittedPatch& patch) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// How a patch fits to those accepted within `radius` of its mean.
  struct Fit {
    bool has_neighbour;
    float distance;  ///< to the nearest of them, metres
    float step;      ///< how far the patch lies above what they let expect, metres
  };

  /// What is expected is the mean height that the neighbours' planes, three quarters as steep, have
  /// at the patch; or, if that comes closer, the height that a curve leads to which begins with a
  /// neighbour's slope and ends with the patch's: so the foot of a bank does not end the ground.
  [[nodiscard]] Fit fit(const FittedPatch& patch, float radius) const noexcept;

 private:
  std::size_t count_ = 0;
  std::size_t capacity_ = 0;
  Buffer<float> columns_;  ///< x, y, z, slope_x, slope_y, trust, one after the other
};

/// Decides which patches are ground.
class PatchJudge {
 public:
  explicit PatchJudge(const SurfaceConfig& config);

  /// By itself: enough points, upright, with more points in its plane than above it, not too high.
  /// The plane is in the sensor frame.
  [[nodiscard]] Verdict judge_alone(const Plane& plane, const SlabCounts& counts) const noexcept;

  /// By those nearer to the sensor: close to where they let expect ground, or, where there are
  /// none, to the sensor's height. `ground`, or `off_surface`.
  [[nodiscard]] Verdict judge_step(const FittedPatch& patch,
                                   const AcceptedPatches& nearer) const noexcept;

 private:
  double least_normal_z_;
  double max_clutter_ratio_;
  double sensor_height_;
  double height_;
  double rise_;
  float step_;
  float step_growth_;
};

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flagstone/mount.hpp"
#include "library/mount/near_points.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::mount {

/// The ground that near points agree on: a plane below the sensor, and how the ground bends away
/// from it. In the frame turned so that `up` is z: z = -height + xx * x^2 + xy * x * y + yy * y^2.
struct GroundPlane {
  Vector3f up{0, 0, 1};          ///< normal of the plane in the frame of the points, unit length
  float height = 0;              ///< metres from the sensor to the plane
  float xx = 0, xy = 0, yy = 0;  ///< one over metres

  /// How far a place in the turned frame lies above the ground, metres.
  [[nodiscard]] float above(float x, float y, float z) const noexcept {
    return z + height - (xx * x * x + xy * x * y + yy * y * y);
  }
};

/// Searches the plane that most of the near points lie on and few below, all directions within the
/// limit for its normal if it is to find the tilt, and refines it by the points close to it.
class PlaneSearch {
 public:
  PlaneSearch(const MountLimits& limits, bool looks_for_tilt);

  /// The more a lean costs, 0 to 100, the more must speak for one; see `belief_in`. Nothing if
  /// there is no level at all.
  std::optional<GroundPlane> find(std::span<const NearPoint> points, float lean_cost) noexcept;

 private:
  struct Candidate {
    GroundPlane plane;
    float score = 0;
  };
  void rank_directions(std::span<const NearPoint> points, float lean_cost) noexcept;
  [[nodiscard]] Candidate level_along(std::span<const NearPoint> points,
                                      const Vector3f& up) noexcept;
  [[nodiscard]] float score(std::span<const NearPoint> points,
                            const GroundPlane& plane) const noexcept;

  MountLimits limits_;
  std::vector<Vector3f> directions_;
  std::vector<NearPoint> few_;   // of the points, for the first look at every direction
  std::vector<float> levels_;    // weights by height
  std::vector<Candidate> best_;  // the directions worth refining, best first
};

/// What near points say of a plane that is taken for the ground.
struct Agreement {
  std::uint32_t cells = 0;  ///< see MountDecision
  float free = 0;
  float below = 0;
  float spread = 0;
  int directions = 0;
  int seen = 0;
  float x = 0,
        y = 0;      ///< where the ground is seen, on the average, metres in the frame of the points
  float range = 0;  ///< and how far away, metres
};

/// Counts, in cells seen from above, where there is ground, where something stands on it, and where
/// something lies below.
class AgreementCount {
 public:
  AgreementCount();

  /// Points no farther than `reach`, metres.
  [[nodiscard]] Agreement of(std::span<const NearPoint> points, const GroundPlane& plane,
                             float reach) noexcept;

 private:
  static constexpr std::size_t width = 32;  // cells along a side
  static constexpr float centre = 16;       // half of them

  std::vector<std::uint8_t> cells_;  // which kinds of points each has
};

/// A decision whose five numbers are filled: how much it is believed, 0 to 1, and, if it is not at
/// all, for which of them. `accepted` where none speaks against it.
void judge(MountDecision& decision, float min_confidence) noexcept;

}  // namespace flagstone::mount

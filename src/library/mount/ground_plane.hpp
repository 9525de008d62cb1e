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

/// The ground fitted to near points: a plane below the sensor with quadratic terms. In the frame
/// rotated so that `up` is z, the ground is z = -height + xx * x^2 + xy * x * y + yy * y^2.
struct GroundPlane {
  Vector3f up{0, 0, 1};          ///< normal of the plane in the frame of the points, unit length
  float height = 0;              ///< metres from the sensor to the plane
  float xx = 0, xy = 0, yy = 0;  ///< quadratic terms, 1/m

  /// Height of a position in the rotated frame above the ground, metres.
  [[nodiscard]] float above(float x, float y, float z) const noexcept {
    return z + height - (xx * x * x + xy * x * y + yy * y * y);
  }
};

/// Searches for the plane with the most near points on it and few below, and refines it with the
/// points close to it. If the tilt is estimated, it tries all normals within the limit.
class PlaneSearch {
 public:
  PlaneSearch(const MountLimits& limits, bool looks_for_tilt);

  /// Finds the plane. A higher `lean_cost`, 0 to 100, requires more evidence for a tilted plane;
  /// see `belief_in`. Returns nothing if no plane has a positive score.
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
  std::vector<NearPoint> few_;   // subset of the points, for the first test of every direction
  std::vector<float> levels_;    // histogram of heights, with weights
  std::vector<Candidate> best_;  // the candidates to refine, best first
};

/// Values that describe how well near points support a ground plane.
struct Agreement {
  std::uint32_t cells = 0;  ///< this and the following values: see MountDecision
  float free = 0;
  float below = 0;
  float spread = 0;
  int directions = 0;
  int seen = 0;
  float x = 0, y = 0;  ///< mean position of the ground points, metres, in the frame of the points
  float range = 0;     ///< mean range of the ground points, metres
};

/// Counts the cells of a horizontal grid that contain ground, obstacles or points below the ground.
class AgreementCount {
 public:
  AgreementCount();

  /// Evaluates a plane. All points must be within `reach` metres.
  [[nodiscard]] Agreement of(std::span<const NearPoint> points, const GroundPlane& plane,
                             float reach) noexcept;

 private:
  static constexpr std::size_t width = 32;  // number of cells along a side
  static constexpr float centre = 16;       // half of `width`

  std::vector<std::uint8_t> cells_;  // the kinds of points in each cell
};

/// Computes the confidence of a decision, 0 to 1, from its values. Sets the status to `accepted`,
/// or to the reason with the lowest factor if the confidence is below `min_confidence`.
void judge(MountDecision& decision, float min_confidence) noexcept;

}  // namespace flagstone::mount

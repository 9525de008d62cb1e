// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/mount.hpp"
#include "library/mount/ground_plane.hpp"
#include "library/mount/near_points.hpp"

namespace flagstone::mount {

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

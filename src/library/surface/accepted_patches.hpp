// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "library/core/buffer.hpp"

namespace flagstone::surface {

/// A patch as seen by its neighbours: a point of its plane and how it rises from there.
struct FittedPatch {
  float x, y, z;           ///< mean of its ground set, metres
  float slope_x, slope_y;  ///< metres a metre
  float points;            ///< in its ground set
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

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/label.hpp"
#include "library/core/buffer.hpp"
#include "library/core/moments.hpp"
#include "library/core/plane.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// Tells ground that the surface passes over from reflections below it: the bottom of a ditch, the
/// foot of a drop between beams that the surface bridges. Such ground lies in a plane; reflections
/// are few or scattered.
class LowerGround {
 public:
  /// `cells` must outlive it.
  explicit LowerGround(const SquareCells& cells);

  /// Of the points of `scan` that `labels` calls noise those in a plane of their own become ground,
  /// those of a square of 4 m, see patches/lower_plane.hpp. Returns how many.
  /// Points lower than ground can be stay noise.
  std::size_t find(const plane_fits::ScanPoints& scan, std::span<Label> labels) noexcept;

 private:
  /// The points labelled noise in one square.
  struct Square {
    Moments all;    ///< of those, or of those near the plane before
    Plane plane;    ///< through them, metres, sensor frame
    double deep;    ///< how many they were at first
    bool searched;  ///< are they enough?
  };

  template <class Work>
  void each_noise(const plane_fits::ScanPoints& scan, std::span<const Label> labels,
                  const Work& work) noexcept;

  const SquareCells* cells_;
  std::uint32_t width_;  ///< squares along a side
  Buffer<Square> squares_;
  Buffer<std::uint32_t> touched_;  ///< numbers of the squares with noise
  std::size_t touched_count_ = 0;
};

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "library/core/buffer.hpp"
#include "library/core/moments.hpp"
#include "library/core/plane.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// Separates ground below the surface from reflections. The surface can pass over the bottom of a
/// ditch or the lower side of a drop between two beams. The points of such ground form a plane;
/// reflections are few or irregular.
class LowerGround {
 public:
  /// `cells` must outlive this object.
  explicit LowerGround(const SquareCells& cells);

  /// Searches each 4 m square for points labelled noise that form a separate plane (see
  /// plane_fits/lower_plane.hpp) and labels them ground. Returns their number. Points below the
  /// noise limit of the cells stay noise.
  std::size_t find(CloudView cloud, std::span<Label> labels) noexcept;

 private:
  /// The points labelled noise in one square.
  struct Square {
    Moments all;    ///< of these points, or of the points near the previous plane
    Plane plane;    ///< through them, relative to the corner of the square, metres
    double deep;    ///< number of points before the first plane
    bool searched;  ///< are there enough points?
  };

  template <class Work>
  void each_noise(CloudView cloud, std::span<const Label> labels, const Work& work) noexcept;

  const SquareCells* cells_;
  std::uint32_t width_;  ///< squares along a side
  Buffer<Square> squares_;
  Buffer<std::uint32_t> touched_;  ///< numbers of the squares with noise
  std::size_t touched_count_ = 0;
};

}  // namespace flagstone::surface

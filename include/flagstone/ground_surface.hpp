// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace flagstone {

/// What the ground is like at one place.
struct GroundSample {
  float height = 0;               ///< z of the ground, metres, sensor frame; NaN: not known here
  std::array<float, 3> normal{};  ///< unit length, z > 0; NaN: not known here
  float slope = 0;       ///< angle between normal and z axis, radians, 0 to pi/2, or NaN too
  float confidence = 0;  ///< 0 (not known) to 1 (measured right here)
};

/// The ground of a scan as one continuous surface, z = height(x, y) in the sensor frame, made by
/// methods that join patches to one (`surface`).
///
/// It is a nest of square grids around the sensor, finer towards it. A grid holds heights at the
/// centres of its cells, between which they are bilinear. A place belongs to the finest grid among
/// whose centres it lies; where grids meet they agree but for what lies between centres: the
/// surface is continuous to some millimetres, where it bends strongly to some centimetres. Where
/// nothing lies beyond, in the outer half of the outermost cells, the ground is as at the nearest
/// place between centres.
class GroundSurface {
 public:
  /// A square grid of heights, centred on the sensor.
  struct Grid {
    float cell = 0;         ///< side of a cell, metres
    std::size_t width = 0;  ///< cells along a side, even
    /// Row by row, y ascending, x ascending within a row: cell (row, column) has its centre at
    /// x = (column + 0.5 - width / 2) * cell, y = (row + 0.5 - width / 2) * cell.
    std::vector<float> heights;      ///< metres; NaN where not known
    std::vector<float> confidences;  ///< 0 to 1

    /// It covers |x| <= extent and |y| <= extent, metres.
    [[nodiscard]] float extent() const noexcept { return static_cast<float>(width) * cell / 2; }
  };

  /// Is there no surface? Queries then answer "not known".
  [[nodiscard]] bool empty() const noexcept { return grids().empty(); }

  /// It covers |x| <= extent() and |y| <= extent(), metres; 0 if empty.
  [[nodiscard]] float extent() const noexcept;

  /// Side of the cells at (x, y), metres; NaN outside.
  [[nodiscard]] float resolution(float x, float y) const noexcept;

  /// The ground at (x, y), metres. Not known outside of the extent and far from any measured
  /// ground: its height is NaN if one of the four around it is and has a share in it, and its
  /// normal and slope if one of the four is. Any bit pattern is allowed.
  [[nodiscard]] GroundSample at(float x, float y) const noexcept;

  /// at(x, y).height, in less time.
  [[nodiscard]] float height(float x, float y) const noexcept;

  /// The grids, coarsest and largest first.
  [[nodiscard]] std::span<const Grid> grids() const noexcept {
    return filled_ ? std::span<const Grid>(grids_) : std::span<const Grid>();
  }

  /// @name For those who write a Segmenter
  /// @{

  /// Empty from now on; memory is kept.
  void clear() noexcept { filled_ = false; }

  /// The grids to fill: coarsest first, each inside the one before. They hold what they held before
  /// the surface was cleared.
  [[nodiscard]] std::vector<Grid>& start() noexcept {
    filled_ = true;
    return grids_;
  }

  /// @}

 private:
  std::vector<Grid> grids_;
  bool filled_ = false;
};

}  // namespace flagstone

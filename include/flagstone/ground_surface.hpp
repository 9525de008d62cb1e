// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace flagstone {

/// The ground at one position.
struct GroundSample {
  float height = 0;               ///< z of the ground, metres, sensor frame; NaN if unknown
  std::array<float, 3> normal{};  ///< unit length, z > 0; NaN if unknown
  float slope = 0;  ///< angle between normal and z axis, radians, 0 to pi/2; NaN if unknown
  /// Probability, 0 to 1, that the height is within 10 cm of the ground, as found in simulated
  /// scenes (docs/benchmarks/accuracy.md); 0 if the height is unknown.
  float confidence = 0;
};

/// The ground of a scan as one continuous surface, z = height(x, y) in the sensor frame.
///
/// The surface is a set of nested square grids around the sensor, finer towards the sensor. A grid
/// contains heights at the centres of its cells, with bilinear interpolation between them. A query
/// uses the finest grid that has cell centres on all sides of the position. At the boundary of two
/// grids the heights agree to a few millimetres, or a few centimetres if the ground bends strongly.
/// The outer half of the outermost cells has the height of the nearest position between cell
/// centres.
///
/// Const member functions can be called from several threads at once.
class GroundSurface {
 public:
  /// A square grid of heights, centred on the sensor.
  struct Grid {
    float cell = 0;         ///< cell size, metres
    std::size_t width = 0;  ///< number of cells along a side, even
    /// Heights of the cell centres, metres; NaN if unknown. Row by row, y ascending, x ascending
    /// within a row: the centre of cell (row, column) is x = (column + 0.5 - width / 2) * cell,
    /// y = (row + 0.5 - width / 2) * cell.
    std::vector<float> heights;
    std::vector<float> confidences;  ///< of each height, 0 to 1; see GroundSample::confidence

    /// Half the side of the grid, metres: it covers |x| <= extent and |y| <= extent.
    [[nodiscard]] float extent() const noexcept { return static_cast<float>(width) * cell / 2; }
  };

  /// True if there is no surface. Every query then returns "unknown".
  [[nodiscard]] bool empty() const noexcept { return grids().empty(); }

  /// Half the side of the surface, metres: it covers |x| <= extent() and |y| <= extent(). 0 if
  /// empty.
  [[nodiscard]] float extent() const noexcept;

  /// Cell size at (x, y), metres; NaN outside the surface.
  [[nodiscard]] float resolution(float x, float y) const noexcept;

  /// The ground at (x, y), in metres. The ground is unknown outside the extent and far from any
  /// measured ground. The height is NaN if one of the four surrounding heights is NaN and has a
  /// weight above 0. The normal and the slope are NaN if any of the four is NaN. x and y may have
  /// any value, including NaN and infinity.
  [[nodiscard]] GroundSample at(float x, float y) const noexcept;

  /// Same as at(x, y).height, but faster.
  [[nodiscard]] float height(float x, float y) const noexcept;

  /// The grids, coarsest and largest first.
  [[nodiscard]] std::span<const Grid> grids() const noexcept {
    return filled_ ? std::span<const Grid>(grids_) : std::span<const Grid>();
  }

  /// @name For implementations of Segmenter
  /// @{

  /// Makes the surface empty but keeps its memory.
  void clear() noexcept { filled_ = false; }

  /// The grids to fill: coarsest first, each inside the previous one. They contain old values.
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

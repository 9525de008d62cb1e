// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "flagstone/status.hpp"

namespace flagstone::render {

/// Heights of ground at the centres of equal square cells, in the world frame.
struct GroundGrid {
  std::span<const float> heights;  ///< row by row from the smallest y, x ascending; NaN if unknown
  std::size_t columns = 0;         ///< cells per row
  double cell = 1;                 ///< side of a cell, metres
  double min_x = 0, min_y = 0;     ///< outer corner of the first cell, metres
};

/// A position in the world frame, metres.
struct MapPosition {
  double x = 0, y = 0;
};

/// Options of an image of the ground of a run.
struct GroundMapPicture {
  /// First and second line above the map, UTF-8; a text that is too long is cut in its middle.
  std::string title;
  std::string subtitle;

  /// Positions of the sensor, in order. A position that is not finite interrupts the line.
  std::span<const MapPosition> path;

  /// Upper limit for width and height, pixels, 640 to 8,192. Small maps have smaller images.
  int max_size = 2400;
};

/// Draws the known ground of a grid as a map and writes it as a PNG file: x points to the right,
/// y points up. The map is coloured by height, shaded with light from the upper left, and has
/// contour lines, coordinates in metres, a scale bar, and the path of the sensor with its start and
/// end. It is blank where the ground is unknown. Cells that are smaller than a pixel should be
/// averaged before. Output is deterministic on one machine; fonts come from the system.
///
/// `invalid_argument` if options are out of range, the grid has no cells or is not a whole number
/// of rows; `unwritable` if the file cannot be written, which leaves no file behind;
/// `out_of_memory`.
[[nodiscard]] Status draw_ground_map(const std::filesystem::path& png, const GroundGrid& grid,
                                     const GroundMapPicture& options) noexcept;

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "flagstone/ground_surface.hpp"
#include "flagstone/status.hpp"

namespace flagstone::render {

/// Options of an image of the ground surface.
struct SurfacePicture {
  /// First and second line above the map, UTF-8; a text that is too long is cut in its middle.
  std::string title;
  std::string subtitle;

  /// Half of the shorter side of the map, metres, 1 to 1,000. 0: the range that contains 98 % of
  /// the confidence of the surface, rounded up to 10 m.
  float range = 0;

  /// Pixels, each 320 to 8,192.
  int width = 1600;
  int height = 1780;
};

/// Draws the ground as a map and writes it as a PNG file: x (forward) points up, y (left) points
/// left. The map is coloured by height, shaded with light from the upper left, and has contour
/// lines. It is paler at low confidence, and blank where the ground is unknown. Output is
/// deterministic on one machine; fonts come from the system.
///
/// `invalid_argument` if options are out of range or the surface is empty; `unwritable` if the file
/// cannot be written, which leaves no file behind; `out_of_memory`.
[[nodiscard]] Status draw_surface(const std::filesystem::path& png, const GroundSurface& surface,
                                  const SurfacePicture& options) noexcept;

}  // namespace flagstone::render

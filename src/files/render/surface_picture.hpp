// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "flagstone/ground_surface.hpp"
#include "flagstone/status.hpp"

namespace flagstone::render {

/// What goes into a picture of the ground besides the ground.
struct SurfacePicture {
  /// First and second line above the picture, UTF-8; what does not fit is cut out of the middle.
  std::string title;
  std::string subtitle;

  /// Half of the picture's shorter side, metres, 1 to 1,000. 0 takes what holds 98 % of the
  /// surface's confidence, rounded up to 10 m.
  float range = 0;

  /// Pixels, each 320 to 8,192.
  int width = 1600;
  int height = 1780;
};

/// Draws the ground as a map and writes it as a PNG file: x, forward, up and y, left, to the left;
/// shaded as if light fell from the upper left, coloured by height, with contour lines, paler where
/// the surface is less sure, blank where it is not known. The same input gives the same bytes on
/// the same machine; fonts are the system's.
///
/// Fails with `invalid_argument` for options out of range and for a surface that is empty; with
/// `unwritable` where the file cannot be written, and then nothing is left behind; with
/// `out_of_memory`.
[[nodiscard]] Status draw_surface(const std::filesystem::path& png, const GroundSurface& surface,
                                  const SurfacePicture& options) noexcept;

}  // namespace flagstone::render

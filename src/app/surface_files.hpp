// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/render/height_map.hpp"
#include "flagstone/ground_surface.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// What belongs to the surface of one scan.
struct SurfaceFiles {
  std::filesystem::path stem;  ///< of the files: STEM.surface.npy, .json and .png
  std::string scan;            ///< file name of the scan, for the frame
  double resolution = 0;       ///< metres a cell; 0: that of the surface's finest cells

  [[nodiscard]] std::filesystem::path grid() const { return stem.string() + ".surface.npy"; }
  [[nodiscard]] std::filesystem::path frame() const { return stem.string() + ".surface.json"; }
  [[nodiscard]] std::filesystem::path picture() const { return stem.string() + ".surface.png"; }

  /// Writes the grid, float32, and its frame. `surface` is not empty. unwritable, out_of_memory.
  [[nodiscard]] Status write(const GroundSurface& surface) const;

 private:
  [[nodiscard]] std::string frame_text(const GroundSurface& surface,
                                       const render::HeightMap& map) const;
};

}  // namespace flagstone::app

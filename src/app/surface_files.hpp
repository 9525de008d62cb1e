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

/// The files for the ground surface of one scan.
struct SurfaceFiles {
  std::filesystem::path stem;  ///< the files are STEM.surface.npy, .json and .png
  std::string scan;            ///< file name of the scan, for the .json file
  double resolution = 0;       ///< cell size in metres; 0: the finest cell size of the surface

  [[nodiscard]] std::filesystem::path grid() const { return stem.string() + ".surface.npy"; }
  [[nodiscard]] std::filesystem::path frame() const { return stem.string() + ".surface.json"; }
  [[nodiscard]] std::filesystem::path picture() const { return stem.string() + ".surface.png"; }

  /// Writes the grid (float32) and its geometry (.json). `surface` must not be empty. Errors:
  /// unwritable, out_of_memory.
  [[nodiscard]] Status write(const GroundSurface& surface) const;

 private:
  [[nodiscard]] std::string frame_text(const GroundSurface& surface,
                                       const render::HeightMap& map) const;
};

}  // namespace flagstone::app

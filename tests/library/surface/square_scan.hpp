// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/surface_config.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"
#include "random_cloud.hpp"

namespace flagstone::tests {

/// A cloud with its points packed and sorted into square cells, as in the pipeline before planes
/// are fitted.
struct SquareScan {
  explicit SquareScan(const std::vector<Point>& cloud, const SurfaceConfig& config = {})
      : cells(config) {
    read(cloud);
  }

  void read(const std::vector<Point>& cloud) {
    points.reserve(cloud.size(), cells);
    for (std::size_t chunk = 0; chunk < plane_fits::chunk_count(cloud.size()); ++chunk) {
      points.read(view_of(cloud), chunk, cells);
    }
    points.sort(cloud.size(), cells);
  }

  surface::SquareCells cells;
  surface::PackedPoints points;
};

}  // namespace flagstone::tests

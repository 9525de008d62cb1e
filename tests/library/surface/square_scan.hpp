// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/surface_config.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/square_cells.hpp"
#include "random_cloud.hpp"

namespace flagstone::tests {

/// A cloud with its points sorted into square cells, as in the pipeline before planes are fitted.
struct SquareScan {
  explicit SquareScan(const std::vector<Point>& cloud, const SurfaceConfig& config = {})
      : cells(config) {
    read(cloud);
    groups.reserve(cloud.size(), cells.group_count());
    groups.group(scan, cloud.size(), cells.group_count());
  }

  surface::SquareCells cells;
  plane_fits::ScanPoints scan;
  plane_fits::BinGroups groups{plane_fits::Listing::points};

 private:
  void read(const std::vector<Point>& cloud) {
    scan.reserve(cloud.size());
    for (std::size_t chunk = 0; chunk < plane_fits::ScanPoints::chunk_count(cloud.size());
         ++chunk) {
      surface::read_chunk(view_of(cloud), chunk, cells, scan);
    }
  }
};

/// The cell of each point, or its reason for having none, from the runs of the scan.
inline std::vector<std::uint32_t> cells_of(const std::vector<Point>& cloud,
                                           const surface::SquareCells& cells) {
  plane_fits::ScanPoints scan;
  scan.reserve(cloud.size());
  std::vector<std::uint32_t> found;
  for (std::size_t chunk = 0; chunk < plane_fits::ScanPoints::chunk_count(cloud.size()); ++chunk) {
    surface::read_chunk(view_of(cloud), chunk, cells, scan);
    const auto [starts, count] = scan.runs(chunk);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t length =
          (starts[i + 1] >> plane_fits::bin_bits) - (starts[i] >> plane_fits::bin_bits);
      found.insert(found.end(), length, starts[i] & ((1U << plane_fits::bin_bits) - 1));
    }
  }
  return found;
}

}  // namespace flagstone::tests

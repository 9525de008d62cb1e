// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "library/patchwork/concentric_zones.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/plane_fits/square_cells.hpp"
#include "random_cloud.hpp"

namespace flagstone::tests {

/// A cloud in the form that the pipeline uses before it fits planes.
struct SortedScan {
  SortedScan(const std::vector<Point>& cloud, const PatchworkConfig& config) : zones(config) {
    scan.reserve(cloud.size());
    for (std::size_t i = 0; i < plane_fits::chunk_count(cloud.size()); ++i) {
      patchwork::read_chunk(view_of(cloud), i, zones, scan);
    }
    groups.reserve(cloud.size(), zones.group_count());
    groups.group(scan, cloud.size(), zones.group_count());
  }

  patchwork::ConcentricZones zones;
  plane_fits::ScanPoints scan;
  plane_fits::BinGroups groups;
};

/// A cloud with its points grouped by square cells.
struct CellPoints {
  CellPoints(const std::vector<Point>& cloud, const SquareCells& square_cells)
      : cells(square_cells) {
    group(cloud);
  }

  void group(const std::vector<Point>& cloud) {
    scan.reserve(cloud.size());
    for (std::size_t i = 0; i < plane_fits::chunk_count(cloud.size()); ++i) {
      read_chunk(view_of(cloud), i, cells, scan);
    }
    groups.reserve(cloud.size(), cells.group_count());
    groups.group(scan, cloud.size(), cells.group_count());
  }

  SquareCells cells;
  plane_fits::ScanPoints scan;
  plane_fits::BinGroups groups;
};

/// Indices of the points of a bin, for both forms of listing.
inline std::vector<std::uint32_t> points_of(const plane_fits::BinGroups& groups,
                                            std::uint32_t bin) {
  std::vector<std::uint32_t> points;
  if (groups.moved()) {
    for (const plane_fits::MovedPoint& p : groups.points(bin)) points.push_back(p.index);
    return points;
  }
  for (const plane_fits::Run& run : groups.runs(bin)) {
    for (std::uint32_t i = 0; i < run.length; ++i) points.push_back(run.begin + i);
  }
  return points;
}

/// One ring of sixteen bins, from 2.7 to 80 m, without a noise limit.
inline PatchworkConfig sixteen_bins() {
  PatchworkConfig config;
  config.zones = {{.ring_radii = {80}, .sectors = 16}};
  config.noise_depth = 1000;
  config.noise_slope = 10;
  return config;
}

}  // namespace flagstone::tests

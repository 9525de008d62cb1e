// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/scan_heights.hpp"

#include <cmath>

#include "library/ground_map/grid_points.hpp"
#include "library/ground_map/poses.hpp"

namespace flagstone {
namespace {

constexpr double fixed_point = 1 << 20;  // units per metre

constexpr double rounding = 0.5 / fixed_point;  // so that rounding down gives the nearest number

std::int64_t to_fixed(float metres) noexcept {
  // Positive, because conversion to an integer rounds towards 0.
  constexpr double above = 1;
  constexpr auto units_above = static_cast<std::int64_t>(above * fixed_point);
  return static_cast<std::int64_t>((double{metres} + above + rounding) * fixed_point) - units_above;
}

// The variance of a measured height, m^2: of the surface, of the mean of the points, and of what
// grows with the range, for pitch and for the footprint of a beam at grazing incidence.
float variance_of(std::uint32_t points, double range) noexcept {
  constexpr double surface = 0.02;      // metres
  constexpr double point = 0.05;        // metres
  constexpr double pitch = 0.002;       // radians
  constexpr double footprint = 0.0002;  // 1/m
  const double grown = footprint * range * range;
  return static_cast<float>(surface * surface + point * point / points +
                            (pitch * range) * (pitch * range) + grown * grown);
}

}  // namespace

std::span<const MeasuredHeight> ScanHeights::measure(CloudView cloud, const Segmentation& result,
                                                     const Pose& pose,
                                                     const GroundMapConfig& config) {
  const double reach = config.max_range;
  const auto [sensor_x, sensor_y, sensor_z] = pose.position;
  const auto first_x = static_cast<std::int64_t>(std::floor((sensor_x - reach) / config.cell));
  const auto first_y = static_cast<std::int64_t>(std::floor((sensor_y - reach) / config.cell));
  const auto width = static_cast<std::size_t>(std::ceil(2 * reach / config.cell)) + 2;
  const std::int64_t end_x = first_x + static_cast<std::int64_t>(width);
  const PointFilter filter{.min_height = -max_deviation,
                           .max_height = max_deviation,
                           .reach = static_cast<float>(reach)};
  const WorldGrid grid{
      .rotation = pose.rotation,
      .to_sensor = {sensor_x - static_cast<double>(first_x) * config.cell,
                    sensor_y - static_cast<double>(first_y) * config.cell, rounding},
      .per_metre = 1 / config.cell,
      .per_metre_up = fixed_point,
      .width = static_cast<std::uint32_t>(width),
      .on_ground = true};
  sums_.assign(width * width, {});
  const LabelledScan scan{.cloud = cloud, .labels = result.labels(), .heights = result.heights()};
  GridPoints points;
  for (std::size_t begin = 0; begin < cloud.size(); begin += GridPoints::capacity) {
    find_in_grid(scan, filter, grid, begin, points);
    for (std::size_t k = 0; k < points.count; ++k) {
      const auto column = static_cast<std::size_t>(points.column[k]);
      Sums& sums = sums_[static_cast<std::size_t>(points.row[k]) * width + column];
      sums.height += to_fixed(scan.heights[static_cast<std::size_t>(points.point[k])]);
      sums.z += points.level[k];
      ++sums.points;
    }
  }

  heights_.clear();
  const GroundSurface& surface = result.surface();
  CellIndex cell{.x = first_x, .y = first_y};
  for (std::size_t k = 0; k < sums_.size(); ++k, ++cell.x) {
    if (cell.x == end_x) cell = {.x = first_x, .y = cell.y + 1};
    const Sums& sums = sums_[k];
    if (sums.points == 0) continue;
    const double dx = (static_cast<double>(cell.x) + 0.5) * config.cell - sensor_x;
    const double dy = (static_cast<double>(cell.y) + 0.5) * config.cell - sensor_y;
    // The surface in the middle of the cell, where the mean of the points is shifted to it.
    const double scale = 1 / (fixed_point * sums.points);
    const WorldVector local = rotated_back(pose, dx, dy, static_cast<double>(sums.z) * scale);
    const float on_surface =
        surface.height(static_cast<float>(local.x), static_cast<float>(local.y));
    if (!std::isfinite(on_surface)) continue;
    const double above = static_cast<double>(sums.height) * scale;
    const WorldVector ground = rotated(pose, local.x, local.y, double{on_surface} + above);
    const double range = std::sqrt(local.x * local.x + local.y * local.y);
    heights_.push_back({.cell = cell,
                        .dx = static_cast<float>(dx),
                        .dy = static_cast<float>(dy),
                        .range = static_cast<float>(range),
                        .height = sensor_z + ground.z,
                        .variance = variance_of(sums.points, range)});
  }
  return heights_;
}

}  // namespace flagstone

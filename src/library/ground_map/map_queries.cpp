// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Queries of a GroundMap: at positions, at the points of a scan, and tile by tile.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/floating_point_mode.hpp"
#include "library/ground_map/grid_points.hpp"
#include "library/ground_map/map_tiles.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/tile_indices.hpp"

namespace flagstone {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Expected error of the height of a cell that has one, metres. Variances are added for: levelling;
// the measurements, as if they were independent; how much they differ, since errors of scans from
// nearby are alike and do not average out; and, in proportion to its weight, the distance to the
// height that contradicts.
float deviation_of(const MapCell& cell) noexcept {
  constexpr float levelling = 0.005F;  // metres
  const HeightEvidence& best = cell.best;
  const HeightEvidence& other = cell.other;
  const float between = other.height - best.height;
  return std::sqrt(levelling * levelling + (1 + best.scatter) / best.weight +
                   other.weight / (best.weight + other.weight) * between * between);
}

/// The four cells around a position, with their weights.
struct Corners {
  std::array<MapCell, 4> cells{};  // x ascending, then y
  double u = 0, v = 0;             // 0..1 between the centres

  template <class Cells>  // map.cell(index) is a cell
  Corners(Cells& map, double x, double y, double size) noexcept {
    const double column = x / size - 0.5;
    const double row = y / size - 0.5;
    if (!(std::abs(x) <= max_world_position) || !(std::abs(y) <= max_world_position)) return;
    const auto first_column = static_cast<std::int64_t>(std::floor(column));
    const auto first_row = static_cast<std::int64_t>(std::floor(row));
    u = column - std::floor(column);
    v = row - std::floor(row);
    for (std::size_t k = 0; k < 4; ++k) {
      cells[k] = map.cell({.x = first_column + static_cast<std::int64_t>(k & 1U),
                           .y = first_row + static_cast<std::int64_t>(k >> 1U)});
    }
  }

  [[nodiscard]] double weight(std::size_t k) const noexcept {
    return ((k & 1U) != 0 ? u : 1 - u) * ((k >> 1U) != 0 ? v : 1 - v);
  }
  [[nodiscard]] double height() const noexcept {
    double sum = 0;
    double known = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!has_height(cells[k])) continue;
      sum += weight(k) * double{cells[k].best.height};
      known += weight(k);
    }
    return known > 0.5 ? sum / known : unknown;
  }
  [[nodiscard]] const MapCell& nearest() const noexcept {
    return cells[(u >= 0.5 ? 1U : 0U) + (v >= 0.5 ? 2U : 0U)];
  }
  [[nodiscard]] bool all() const noexcept { return std::ranges::all_of(cells, has_height); }
};

}  // namespace

double GroundMap::height(double x, double y) const noexcept {
  return tiles_->base + Corners(*tiles_, x, y, tiles_->config.cell).height();
}

MapSample GroundMap::at(double x, double y) const noexcept {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const Corners corners(*tiles_, x, y, tiles_->config.cell);
  MapSample sample{.height = tiles_->base + corners.height(),
                   .normal = {none, none, none},
                   .slope = none,
                   .deviation = none};
  if (const MapCell& cell = corners.nearest(); has_height(cell)) {
    sample.deviation = deviation_of(cell);
    sample.scans = cell.best.scans;
    sample.contradictions = cell.other.scans;
    sample.age = static_cast<std::uint32_t>(tiles_->scans) - cell.last_scan;
  }
  if (corners.all()) {
    const auto z = [&](std::size_t k) { return double{corners.cells[k].best.height}; };
    const double size = tiles_->config.cell;
    const double rise_x = ((1 - corners.v) * (z(1) - z(0)) + corners.v * (z(3) - z(2))) / size;
    const double rise_y = ((1 - corners.u) * (z(2) - z(0)) + corners.u * (z(3) - z(1))) / size;
    const double length = std::sqrt(1 + rise_x * rise_x + rise_y * rise_y);
    sample.normal = {static_cast<float>(-rise_x / length), static_cast<float>(-rise_y / length),
                     static_cast<float>(1 / length)};
    sample.slope = static_cast<float>(std::atan(std::hypot(rise_x, rise_y)));
  }
  return sample;
}

namespace {

/// Cells of positions that are near each other: most are in the same tile as the one before.
template <class Tiles>
class NearbyCells {
 public:
  explicit NearbyCells(const Tiles& tiles) noexcept : tiles_(tiles) {}

  MapCell cell(CellIndex index) noexcept {
    const MapCell* const found = find(index);
    return found == nullptr ? tiles_.cell(index) : *found;
  }

  /// The height of a cell: less to copy.
  HeightEvidence best(CellIndex index) noexcept {
    const MapCell* const found = find(index);
    return found == nullptr ? tiles_.cell(index).best : found->best;
  }

 private:
  const MapCell* find(CellIndex index) noexcept {
    const TileIndex tile = CellTiles::tile_of(index);
    if (last_ == nullptr || !(tile == index_of_last_)) {
      last_ = tiles_.cells.tile(tile);
      index_of_last_ = tile;
    }
    return last_ == nullptr ? nullptr : &(*last_)[CellTiles::offset_in_tile(index)];
  }

  const Tiles& tiles_;
  TileIndex index_of_last_;
  const CellTiles::Tile* last_ = nullptr;
};

/// Heights of the points of a scan above a map.
template <class Tiles>
class HeightsAboveMap {
 public:
  HeightsAboveMap(const Tiles& tiles, const Pose& pose, const Levelling& levelling) noexcept
      : cells_(tiles),
        cell_(tiles.config.cell),
        pose_(pose),
        slope_x_(levelling.slope_x),
        slope_y_(levelling.slope_y),
        sensor_height_(pose.position[2] - levelling.offset - tiles.base) {}

  /// Metres; NaN if the map or the point is unknown.
  float operator()(const Point& point) noexcept {
    const auto [dx, dy, dz] = rotated(pose_, double{point.x}, double{point.y}, double{point.z});
    const Corners corners(cells_, pose_.position[0] + dx, pose_.position[1] + dy, cell_);
    const double z = sensor_height_ + dz - slope_x_ * dx - slope_y_ * dy;
    return static_cast<float>(z - corners.height());
  }

 private:
  NearbyCells<Tiles> cells_;
  double cell_;  // metres
  const Pose& pose_;
  double slope_x_, slope_y_, sensor_height_;  // the last one above the base of the map, metres
};

// Calls `check(i)` for each point that is labelled ground and is more than `height` metres above
// the cell of the map that contains it.
template <class Tiles, class Check>
void for_each_high_point(const Tiles& tiles, const LabelledScan& scan, const Pose& pose,
                         const Levelling& levelling, float height, const Check& check) noexcept {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float reach = 200;                   // metres
  constexpr double units_per_metre = 1U << 20U;  // of levels
  const double size = tiles.config.cell;
  const CellIndex first{
      .x = static_cast<std::int64_t>(std::floor((pose.position[0] - 2 * reach) / size)),
      .y = static_cast<std::int64_t>(std::floor((pose.position[1] - 2 * reach) / size))};
  // Levels are relative to the sensor.
  const WorldGrid grid{.rotation = pose.rotation,
                       .to_sensor = {pose.position[0] - static_cast<double>(first.x) * size,
                                     pose.position[1] - static_cast<double>(first.y) * size, 0},
                       .slope_x = levelling.slope_x,
                       .slope_y = levelling.slope_y,
                       .per_metre = 1 / size,
                       .per_metre_up = units_per_metre,
                       .width = static_cast<std::uint32_t>(4 * reach / size)};
  const PointFilter filter{.min_height = -infinity, .max_height = infinity, .reach = reach};
  const auto sensor = static_cast<float>(pose.position[2] - levelling.offset - tiles.base);
  NearbyCells cells(tiles);
  GridPoints points;
  for (std::size_t begin = 0; begin < scan.cloud.size(); begin += GridPoints::capacity) {
    find_in_grid(scan, filter, grid, begin, points);
    for (std::size_t k = 0; k < points.count; ++k) {
      const HeightEvidence ground =
          cells.best({.x = first.x + points.column[k], .y = first.y + points.row[k]});
      const float up =
          static_cast<float>(points.level[k]) * static_cast<float>(1 / units_per_metre);
      if (ground.weight > 0 && sensor + up - ground.height > height) {
        check(static_cast<std::size_t>(points.point[k]));
      }
    }
  }
}

Status check_values(CloudView cloud, const Pose& pose, std::size_t values, const char* name) {
  if (values != cloud.size()) {
    return Status(StatusCode::invalid_argument,
                  std::string("ground map: the number of ") + name +
                      " differs from the number of points (expected one per point)");
  }
  return is_valid(pose) ? Status() : invalid_pose();
}

}  // namespace

Status GroundMap::heights(CloudView cloud, const Pose& pose, const Levelling& levelling,
                          std::span<float> heights) const {
  if (Status status = check_values(cloud, pose, heights.size(), "heights"); !status.ok()) {
    return status;
  }
  HeightsAboveMap height_of(*tiles_, pose, levelling);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = height_of(cloud[i]);
  return {};
}

Status GroundMap::relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, std::span<Label> labels) const {
  if (Status status = check_scan("ground map", cloud, result, pose); !status.ok()) return status;
  if (Status status = check_values(cloud, pose, labels.size(), "labels"); !status.ok()) {
    return status;
  }
  const ScopedFloatingPointMode mode;
  const float margin = PointRule().margin;
  HeightsAboveMap height_of(*tiles_, pose, levelling);
  // Only points that are clearly above the nearest cell need the slower exact height.
  const LabelledScan scan{.cloud = cloud, .labels = labels, .heights = result.heights()};
  for_each_high_point(*tiles_, scan, pose, levelling, margin / 2, [&](std::size_t i) {
    if (height_of(cloud[i]) > margin) labels[i] = Label::nonground;
  });
  return {};
}

std::vector<TileIndex> GroundMap::tiles() const {
  std::vector<TileIndex> indices;
  tiles_->cells.for_each([&](TileIndex index, const CellTiles::Tile& tile) {
    if (std::ranges::any_of(tile, has_height)) indices.push_back(index);
  });
  if (tiles_->archive)
    tiles_->archive->for_each([&](TileIndex index) { indices.push_back(index); });
  sort_tiles(indices);
  return indices;
}

bool GroundMap::read_tile(TileIndex index, MapTile& tile) const noexcept {
  const CellTiles::Tile* cells = tiles_->cells.tile(index);
  std::unique_ptr<CellTiles::Tile> stored;
  if (cells == nullptr && tiles_->archive && tiles_->archive->contains(index)) {
    stored.reset(new (std::nothrow) CellTiles::Tile());
    if (stored == nullptr || !tiles_->archive->read(index, *stored).ok()) return false;
    cells = stored.get();
  }
  if (cells == nullptr || std::ranges::none_of(*cells, has_height)) return false;
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t k = 0; k < MapTile::cells; ++k) {
    const MapCell& cell = (*cells)[k];
    const bool known = has_height(cell);
    tile.height[k] = known ? static_cast<float>(tiles_->base + double{cell.best.height}) : none;
    tile.deviation[k] = known ? deviation_of(cell) : none;
    tile.scans[k] = cell.best.scans;
    tile.contradictions[k] = cell.other.scans;
    tile.last_scan[k] = cell.last_scan;
  }
  return true;
}

std::size_t GroundMap::scans() const noexcept { return tiles_->scans; }

std::size_t GroundMap::cells() const noexcept {
  return tiles_->cells.cells_with_height() +
         (tiles_->archive ? tiles_->archive->cells_with_height() : 0);
}

std::size_t GroundMap::bytes() const noexcept { return tiles_->cells.bytes(); }

}  // namespace flagstone

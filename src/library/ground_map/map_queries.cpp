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
#include "library/ground_map/scan_heights.hpp"
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
  CellIndex first{.x = nowhere};   // of cells[0]

  Corners() = default;
  template <class Cells>  // map.cell(index) is a cell
  Corners(Cells& map, double x, double y, double size) noexcept {
    move_to(map, x, y, size);
  }

  /// Cells are only read if they differ from those of the position before.
  template <class Cells>
  void move_to(Cells& map, double x, double y, double size) noexcept {
    if (!(std::abs(x) <= max_world_position) || !(std::abs(y) <= max_world_position)) {
      *this = Corners();
      return;
    }
    const double column = x / size - 0.5;
    const double row = y / size - 0.5;
    const CellIndex corner{.x = static_cast<std::int64_t>(std::floor(column)),
                           .y = static_cast<std::int64_t>(std::floor(row))};
    u = column - std::floor(column);
    v = row - std::floor(row);
    if (corner == first) return;
    first = corner;
    for (std::size_t k = 0; k < 4; ++k) {
      cells[k] = map.cell({.x = corner.x + static_cast<std::int64_t>(k & 1U),
                           .y = corner.y + static_cast<std::int64_t>(k >> 1U)});
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

 private:
  static constexpr std::int64_t nowhere = std::numeric_limits<std::int64_t>::max();
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

/// A point above a map.
struct PointAboveMap {
  double x = 0, y = 0;  // world frame, metres
  float height = 0;     // metres; NaN if the map or the point is unknown
  const MapCell& cell;  // the cell of the map that contains it; valid until the next point
};

/// Finds the points of a scan above a map.
template <class Tiles>
class PointsAboveMap {
 public:
  PointsAboveMap(const Tiles& tiles, const Pose& pose, const Levelling& levelling) noexcept
      : cells_(tiles),
        cell_(tiles.config.cell),
        pose_(pose),
        slope_x_(levelling.slope_x),
        slope_y_(levelling.slope_y),
        sensor_height_(pose.position[2] - levelling.offset - tiles.base) {}

  PointAboveMap operator()(const Point& point) noexcept {
    const auto [dx, dy, dz] = rotated(pose_, double{point.x}, double{point.y}, double{point.z});
    const double x = pose_.position[0] + dx;
    const double y = pose_.position[1] + dy;
    corners_.move_to(cells_, x, y, cell_);
    const double z = sensor_height_ + dz - slope_x_ * dx - slope_y_ * dy;
    return {.x = x,
            .y = y,
            .height = static_cast<float>(z - corners_.height()),
            .cell = corners_.nearest()};
  }

 private:
  NearbyCells<Tiles> cells_;
  Corners corners_;
  double cell_;  // metres
  const Pose& pose_;
  double slope_x_, slope_y_, sensor_height_;  // the last one above the base of the map, metres
};

/// The cells of a map around a sensor, as a grid for find_in_grid().
struct CellsAround {
  /// `reach` in metres.
  CellsAround(double cell, double reach, const Pose& pose, const Levelling& levelling) noexcept
      : first{.x = static_cast<std::int64_t>(std::floor((pose.position[0] - reach) / cell)),
              .y = static_cast<std::int64_t>(std::floor((pose.position[1] - reach) / cell))},
        // Levels are relative to the sensor.
        grid{.rotation = pose.rotation,
             .to_sensor = {pose.position[0] - static_cast<double>(first.x) * cell,
                           pose.position[1] - static_cast<double>(first.y) * cell, 0},
             .slope_x = levelling.slope_x,
             .slope_y = levelling.slope_y,
             .per_metre = 1 / cell,
             .per_metre_up = units_per_metre,
             .width = static_cast<std::uint32_t>(2 * reach / cell) + 2} {}

  [[nodiscard]] std::size_t size() const noexcept { return std::size_t{grid.width} * grid.width; }
  /// The number of the cell of a point that is inside.
  [[nodiscard]] std::size_t cell(const GridPoints& points, std::size_t k) const noexcept {
    return static_cast<std::size_t>(points.row[k]) * grid.width +
           static_cast<std::size_t>(points.column[k]);
  }
  [[nodiscard]] CellIndex index(const GridPoints& points, std::size_t k) const noexcept {
    return {.x = first.x + points.column[k], .y = first.y + points.row[k]};
  }
  /// Metres above the sensor.
  static float up(const GridPoints& points, std::size_t k) noexcept {
    return static_cast<float>(points.level[k]) * static_cast<float>(1 / units_per_metre);
  }

  static constexpr double units_per_metre = 1U << 20U;  // of levels

  CellIndex first;
  WorldGrid grid;
};

// The label of a point above the map depends on obstacles in its cell, as in stage F of `surface`.
// The map is uncertain by its expected error, but walls that some scans label ground increase that.
bool is_too_high(const PointAboveMap& point, bool has_obstacle) noexcept {
  constexpr float max_uncertainty = 0.06F;  // metres
  const PointRule rule;
  const float margin = has_obstacle ? rule.obstacle_margin : rule.margin;
  return point.height > margin &&
         point.height > margin + std::min(deviation_of(point.cell), max_uncertainty);
}

constexpr float reach_of_labels = 200;  // metres

// The cells that contain an obstacle in one scan. May throw std::bad_alloc.
std::vector<bool> find_obstacles(const CellsAround& around, CloudView cloud,
                                 const Segmentation& result) {
  constexpr float overhang = 2.5F;  // metres
  const PointFilter filter{.nonground = true,
                           .min_height = 1.25F * PointRule().obstacle_height,
                           .max_height = overhang,
                           .reach = reach_of_labels};
  std::vector<bool> has_obstacle(around.size());
  const LabelledScan scan{.cloud = cloud, .labels = result.labels(), .heights = result.heights()};
  GridPoints points;
  for (std::size_t begin = 0; begin < cloud.size(); begin += GridPoints::capacity) {
    find_in_grid(scan, filter, around.grid, begin, points);
    for (std::size_t k = 0; k < points.count; ++k) has_obstacle[around.cell(points, k)] = true;
  }
  return has_obstacle;
}

// Calls `check(i, has_obstacle)` for points that are labelled ground, unless they are clearly lower
// than the margin above the cell of the map that contains them. May throw std::bad_alloc.
template <class Tiles, class Check>
void for_each_high_point(const Tiles& tiles, CloudView cloud, const Segmentation& result,
                         const Pose& pose, const Levelling& levelling,
                         std::span<const Label> labels, const Check& check) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float clearly = 0.12F;  // metres: half of a cell on a slope
  const PointRule rule;
  const CellsAround around(tiles.config.cell, reach_of_labels, pose, levelling);
  const std::vector<bool> has_obstacle = find_obstacles(around, cloud, result);
  const LabelledScan scan{.cloud = cloud, .labels = labels, .heights = result.heights()};
  const PointFilter filter{
      .min_height = -infinity, .max_height = infinity, .reach = reach_of_labels};
  const auto sensor = static_cast<float>(pose.position[2] - levelling.offset - tiles.base);
  NearbyCells cells(tiles);
  std::size_t last = around.size();  // consecutive points are often in one cell
  bool is_narrow = false;
  float limit = infinity;  // metres above the sensor
  GridPoints points;
  for (std::size_t begin = 0; begin < cloud.size(); begin += GridPoints::capacity) {
    find_in_grid(scan, filter, around.grid, begin, points);
    for (std::size_t k = 0; k < points.count; ++k) {
      const std::size_t cell = around.cell(points, k);
      if (cell != last) {
        last = cell;
        is_narrow = has_obstacle[cell];
        const HeightEvidence ground = cells.best(around.index(points, k));
        const float margin = is_narrow ? rule.obstacle_margin : rule.margin;
        limit = ground.weight > 0 ? ground.height - sensor + margin - clearly : infinity;
      }
      if (CellsAround::up(points, k) > limit) {
        check(static_cast<std::size_t>(points.point[k]), is_narrow);
      }
    }
  }
}

/// The number of points in each cell that measure the ground in one scan: those that a map uses,
/// within `reach`.
class GroundCounts {
 public:
  static constexpr double reach = 100;  // metres

  /// May throw std::bad_alloc.
  GroundCounts(double cell, CloudView cloud, const Segmentation& result, const Pose& pose)
      : cell_(cell), around_(cell, reach, pose, {}), counts_(around_.size()) {
    const PointFilter filter{.min_height = -ScanHeights::max_deviation,
                             .max_height = ScanHeights::max_deviation,
                             .reach = static_cast<float>(reach)};
    const LabelledScan scan{.cloud = cloud, .labels = result.labels(), .heights = result.heights()};
    GridPoints points;
    for (std::size_t begin = 0; begin < cloud.size(); begin += GridPoints::capacity) {
      find_in_grid(scan, filter, around_.grid, begin, points);
      for (std::size_t k = 0; k < points.count; ++k) {
        std::uint16_t& count = counts_[around_.cell(points, k)];
        if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
      }
    }
  }

  /// At (x, y), world frame, metres.
  [[nodiscard]] std::uint16_t at(double x, double y) const noexcept {
    const double column = std::floor(x / cell_) - static_cast<double>(around_.first.x);
    const double row = std::floor(y / cell_) - static_cast<double>(around_.first.y);
    const double width = around_.grid.width;
    const bool is_inside = column >= 0 && column < width && row >= 0 && row < width;
    if (!is_inside) return 0;
    return counts_[static_cast<std::size_t>(row) * around_.grid.width +
                   static_cast<std::size_t>(column)];
  }

 private:
  double cell_;
  CellsAround around_;
  std::vector<std::uint16_t> counts_;
};

// The mean of a height above the surface of a scan and a height above the map, weighted by their
// expected errors. `points`: of the scan on the ground, in the same cell.
float combined_height(float own, const PointAboveMap& map, std::uint16_t points) noexcept {
  if (std::isnan(map.height)) return own;
  if (std::isnan(own) || points == 0) return map.height;
  if (!has_height(map.cell)) return own;
  constexpr float surface = 0.003F;  // metres
  constexpr float point = 0.01F;     // metres: small, since beams meet the ground at small angles
  const float own_variance = surface * surface + point * point / static_cast<float>(points);
  const float deviation = deviation_of(map.cell);
  const float map_variance = deviation * deviation;
  return (own * map_variance + map.height * own_variance) / (map_variance + own_variance);
}

Status check_values(CloudView cloud, std::size_t values, const char* name) {
  if (values == cloud.size()) return {};
  return Status(StatusCode::invalid_argument,
                std::string("ground map: the number of ") + name +
                    " differs from the number of points (expected one per point)");
}

// Heights of all points above the ground of the scan and the map.
template <class Tiles>
void combine_heights(const Tiles& tiles, CloudView cloud, const Segmentation& result,
                     const Pose& pose, const Levelling& levelling, std::span<float> heights) {
  const GroundCounts counts(tiles.config.cell, cloud, result, pose);
  PointsAboveMap above_map(tiles, pose, levelling);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Label label = result.labels()[i];
    heights[i] = result.heights()[i];
    if (label == Label::invalid || label == Label::out_of_range) continue;
    const PointAboveMap above = above_map(cloud[i]);
    heights[i] = combined_height(heights[i], above, counts.at(above.x, above.y));
  }
}

}  // namespace

Status GroundMap::heights(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, std::span<float> heights) const {
  if (Status status = check_scan("ground map", cloud, result, pose); !status.ok()) return status;
  if (Status status = check_values(cloud, heights.size(), "heights"); !status.ok()) return status;
  const ScopedFloatingPointMode mode;
  try {
    combine_heights(*tiles_, cloud, result, pose, levelling, heights);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  return {};
}

Status GroundMap::relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                          const Levelling& levelling, std::span<Label> labels) const {
  if (Status status = check_scan("ground map", cloud, result, pose); !status.ok()) return status;
  if (Status status = check_values(cloud, labels.size(), "labels"); !status.ok()) return status;
  const ScopedFloatingPointMode mode;
  PointsAboveMap above_map(*tiles_, pose, levelling);
  const auto check = [&](std::size_t i, bool has_obstacle) {
    if (is_too_high(above_map(cloud[i]), has_obstacle)) labels[i] = Label::nonground;
  };
  try {
    for_each_high_point(*tiles_, cloud, result, pose, levelling, labels, check);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/ground_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "library/core/floating_point_mode.hpp"
#include "library/core/setting.hpp"
#include "library/ground_map/last_levelling.hpp"
#include "library/ground_map/level_fit.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/scan_heights.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/tile_archive.hpp"
#include "library/ground_map/tile_bytes.hpp"
#include "library/ground_map/tile_indices.hpp"
#include "library/ground_map/tiles.hpp"

namespace flagstone {

void GroundMapConfig::check() const {
  constexpr const char* name = "ground map";
  check_number(name, "cell", cell, {.low = 0.1, .high = 2, .unit = "m"});
  check_number(name, "max_range", max_range, {.low = 5, .high = 100, .unit = "m"});
  if (window != 0) {
    check_number(name, "window", window,
                 {.low = 50, .high = 1e6, .unit = "m", .remark = ", or 0 to keep everything"});
  }
  check_number(name, "max_correction", max_correction, {.low = 0, .high = 100, .unit = "m"});
  if (window != 0 && max_memory != 0) {
    throw std::invalid_argument(
        "ground map: window and max_memory exclude each other (expected at most one of them)");
  }
}

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Adds a height to the hypothesis of the cell that it fits; otherwise it replaces the second one.
void add_height(MapCell& cell, float height, float variance) noexcept {
  const auto fits = [&](const HeightEvidence& evidence) {
    constexpr float deviations = 3;
    constexpr float tolerance = 0.06F;  // metres
    return evidence.weight > 0 &&
           std::abs(height - evidence.height) <
               deviations * std::sqrt(variance + 1 / evidence.weight) + tolerance;
  };
  const float weight = 1 / variance;
  if (cell.best.weight == 0 || fits(cell.best)) {
    cell.best.add(height, weight);
    return;
  }
  if (!fits(cell.other)) cell.other = {};
  cell.other.add(height, weight);
  if (cell.other.weight > cell.best.weight) std::swap(cell.best, cell.other);
}

}  // namespace

namespace {

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

}  // namespace

class GroundMap::Tiles {
 public:
  GroundMapConfig config;
  CellTiles cells;
  std::unique_ptr<TileArchive> archive;  // of a map with a TileStore, otherwise null
  double base = 0;  // z of the sensor in the first scan; stored heights are relative to it
  std::size_t scans = 0;
  LastLevelling last;

  /// Reads those tiles of the heights that are in the store.
  Status recall(std::span<const MeasuredHeight> heights);

  /// Stores the tiles beyond the memory limit.
  Status unload();

  /// A cell in memory or in the store; without heights if the map does not have it.
  [[nodiscard]] MapCell cell(CellIndex index) const noexcept {
    if (const MapCell* const found = cells.find(index); found != nullptr) return *found;
    return archive ? archive->cell(index) : MapCell();
  }
};

Status GroundMap::Tiles::recall(std::span<const MeasuredHeight> heights) {
  if (!archive) return {};
  for (const MeasuredHeight& measured : heights) {
    const TileIndex index = CellTiles::tile_of(measured.cell);
    if (!archive->contains(index)) continue;
    if (Status status = archive->read(index, cells.allocate(index, scans)); !status.ok()) {
      cells.remove(index);
      return status;
    }
    archive->forget(index);
  }
  return {};
}

Status GroundMap::Tiles::unload() {
  if (!archive) return {};
  for (const TileIndex index : cells.least_used(config.max_memory / sizeof(CellTiles::Tile))) {
    const CellTiles::Tile& tile = *cells.tile(index);
    // A tile that was only allocated has nothing to store.
    if (std::ranges::any_of(tile, has_height)) {
      if (Status status = archive->put(index, tile); !status.ok()) return status;
    }
    cells.remove(index);
  }
  return {};
}

/// Working memory for one scan.
class GroundMap::Builder {
 public:
  ScanHeights heights;
  std::vector<HeightDifference> differences;
  std::vector<double> memory;
};

GroundMap::GroundMap(const GroundMapConfig& config) : GroundMap(config, nullptr) {}

GroundMap::GroundMap(const GroundMapConfig& config, std::shared_ptr<TileStore> store)
    : tiles_(std::make_unique<Tiles>()), builder_(std::make_unique<Builder>()) {
  config.check();
  if ((config.max_memory > 0) != (store != nullptr)) {
    throw std::invalid_argument(
        "ground map: max_memory and a store need each other (expected both or neither)");
  }
  tiles_->config = config;
  if (store != nullptr) tiles_->archive = std::make_unique<TileArchive>(std::move(store));
}

GroundMap::~GroundMap() = default;
GroundMap::GroundMap(GroundMap&&) noexcept = default;
GroundMap& GroundMap::operator=(GroundMap&&) noexcept = default;

const GroundMapConfig& GroundMap::config() const noexcept { return tiles_->config; }

Status GroundMap::fit(CloudView cloud, const Segmentation& result, const Pose& pose,
                      std::span<const MeasuredHeight>& heights, Levelling& levelling) {
  levelling = {};
  if (cloud.size() != result.labels().size() || cloud.size() != result.heights().size()) {
    return Status(StatusCode::invalid_argument,
                  "ground map: the result has no heights of this cloud (expected the result of a "
                  "method such as surface for the same cloud)");
  }
  if (!is_valid(pose)) return invalid_pose();
  constexpr float max_range_for_level = 30;  // metres
  heights = builder_->heights.measure(cloud, result, pose, tiles_->config);
  if (Status status = tiles_->recall(heights); !status.ok()) return status;
  builder_->differences.clear();
  TileIndex last;  // most cells are in the same tile as the one before
  const CellTiles::Tile* tile = nullptr;
  for (const MeasuredHeight& measured : heights) {
    if (measured.range > max_range_for_level) continue;
    const TileIndex index = CellTiles::tile_of(measured.cell);
    if (tile == nullptr || !(index == last)) tile = tiles_->cells.tile(index);
    last = index;
    if (tile == nullptr) continue;
    const MapCell& cell = (*tile)[CellTiles::offset_in_tile(measured.cell)];
    if (!has_height(cell)) continue;
    builder_->differences.push_back(
        {.dx = measured.dx,
         .dy = measured.dy,
         .difference = measured.height - tiles_->base - double{cell.best.height}});
  }
  levelling = fit_level(builder_->differences, tiles_->last.continued_at(pose),
                        tiles_->config.max_correction, builder_->memory);
  levelling = tiles_->last.without_forgotten(pose, levelling);
  return {};
}

Status GroundMap::level(CloudView cloud, const Segmentation& result, const Pose& pose,
                        Levelling& levelling) {
  const ScopedFloatingPointMode mode;
  try {
    std::span<const MeasuredHeight> heights;
    if (Status status = fit(cloud, result, pose, heights, levelling); !status.ok()) return status;
    return tiles_->unload();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status GroundMap::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                      Levelling& levelling) {
  const ScopedFloatingPointMode mode;
  Tiles& map = *tiles_;
  try {
    std::span<const MeasuredHeight> heights;
    if (const Status status = fit(cloud, result, pose, heights, levelling); !status.ok()) {
      return status;
    }
    for (const MeasuredHeight& measured : heights) {
      map.cells.allocate(CellTiles::tile_of(measured.cell), map.scans);
    }
    if (map.scans == 0) map.base = pose.position[2];
    ++map.scans;
    map.last.replace(pose, levelling);
    TileIndex last;
    CellTiles::Tile* tile = nullptr;
    for (const MeasuredHeight& measured : heights) {
      const double correction = levelling.offset + levelling.slope_x * double{measured.dx} +
                                levelling.slope_y * double{measured.dy};
      const TileIndex index = CellTiles::tile_of(measured.cell);
      if (tile == nullptr || !(index == last)) tile = map.cells.tile(index);
      last = index;
      MapCell& cell = (*tile)[CellTiles::offset_in_tile(measured.cell)];
      add_height(cell, static_cast<float>(measured.height - map.base - correction),
                 measured.variance);
      cell.last_scan = static_cast<std::uint32_t>(map.scans);
    }
    if (Status status = map.unload(); !status.ok()) return status;
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  if (map.config.window > 0) {
    const CellIndex here{
        .x = static_cast<std::int64_t>(std::floor(pose.position[0] / map.config.cell)),
        .y = static_cast<std::int64_t>(std::floor(pose.position[1] / map.config.cell))};
    map.cells.remove_beyond(here, map.config.window / map.config.cell);
  }
  return {};
}

namespace {

/// The four cells around a position, with their weights.
struct Corners {
  std::array<MapCell, 4> cells{};  // x ascending, then y
  double u = 0, v = 0;             // 0..1 between the centres

  template <class Cells>  // cells.cell(index) is a cell
  Corners(const Cells& map, double x, double y, double size) noexcept {
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

namespace {

std::array<double, 8> numbers_of(const LastLevelling& last) noexcept {
  const auto& [plane, mean, position] = last;
  return {plane.offset, plane.slope_x, plane.slope_y, mean.offset,
          mean.slope_x, mean.slope_y,  position[0],   position[1]};
}

LastLevelling last_levelling_of(const std::array<double, 8>& numbers) noexcept {
  const auto& [offset, x, y, mean_offset, mean_x, mean_y, position_x, position_y] = numbers;
  return {.plane = {.offset = offset, .slope_x = x, .slope_y = y},
          .mean = {.offset = mean_offset, .slope_x = mean_x, .slope_y = mean_y},
          .position = {position_x, position_y}};
}

constexpr std::string_view map_magic = "fsgmap01";

}  // namespace

Status GroundMap::to_bytes(std::vector<std::byte>& bytes) const {
  bytes.clear();
  try {
    StateWriter writer(bytes);
    const std::vector<TileIndex> indices = tiles();
    writer.start(map_magic);
    writer.add(tiles_->config.cell);
    writer.add(tiles_->base);
    writer.add(std::uint64_t{tiles_->scans});
    for (const double number : numbers_of(tiles_->last)) writer.add(number);
    writer.add(std::uint64_t{indices.size()});
    std::vector<std::byte> stored;
    for (const TileIndex index : indices) {
      write_index(index, writer);
      if (const CellTiles::Tile* const tile = tiles_->cells.tile(index); tile != nullptr) {
        write_cells(*tile, writer);
        continue;
      }
      if (Status status = tiles_->archive->bytes_of(index, stored); !status.ok()) {
        bytes.clear();
        return status;
      }
      bytes.insert(bytes.end(), stored.begin(), stored.end());
    }
    writer.finish();
    return {};
  } catch (const std::bad_alloc&) {
    bytes.clear();
    return Status(StatusCode::out_of_memory);
  }
}

Status GroundMap::from_bytes(std::span<const std::byte> bytes) {
  try {
    StateReader reader(bytes);
    if (Status status = reader.open(map_magic, "the state of a ground map"); !status.ok())
      return status;
    const auto cell = reader.read<double>();
    const auto base = reader.read<double>();
    const auto scans = reader.read<std::uint64_t>();
    std::array<double, 8> numbers{};
    for (double& number : numbers) number = reader.read<double>();
    const auto count = reader.read<std::uint64_t>();
    if (reader.failed()) return bad_state(reader.offset(), "the header is incomplete", "104 bytes");
    if (cell != tiles_->config.cell) {
      return bad_state(map_magic.size(), "the size of the cells differs",
                       "the setting `cell` of this map");
    }
    const auto is_possible = [](double number) {
      return std::abs(number) <= LastLevelling::no_position;
    };
    if (!(std::abs(base) <= max_world_position) || !std::ranges::all_of(numbers, is_possible) ||
        scans > std::numeric_limits<std::uint32_t>::max()) {
      return bad_state(map_magic.size() + sizeof cell, "an impossible number in the header",
                       "positions up to 10,000 km and at most 2^32 - 1 scans");
    }
    CellTiles cells;
    TileIndexReader indices(static_cast<double>(tile_width) * cell);
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::size_t offset = reader.offset();
      TileIndex index;
      if (Status status = indices.read(reader, index); !status.ok()) return status;
      CellTiles::Tile& tile = cells.allocate(index, scans);
      if (Status status = read_cells(reader, tile); !status.ok()) return status;
      if (std::ranges::any_of(tile, [&](const MapCell& c) { return c.last_scan > scans; })) {
        return bad_state(offset, "a cell of a later scan", "at most the number of scans");
      }
    }
    if (reader.left() > 0) {
      return bad_state(reader.offset(), "bytes after the last tile", "the end");
    }
    tiles_->cells = std::move(cells);
    tiles_->base = base;
    tiles_->scans = static_cast<std::size_t>(scans);
    tiles_->last = last_levelling_of(numbers);
    if (tiles_->archive) tiles_->archive->clear();
    return tiles_->unload();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

std::size_t GroundMap::scans() const noexcept { return tiles_->scans; }

std::size_t GroundMap::cells() const noexcept {
  return tiles_->cells.cells_with_height() +
         (tiles_->archive ? tiles_->archive->cells_with_height() : 0);
}

std::size_t GroundMap::bytes() const noexcept { return tiles_->cells.bytes(); }

}  // namespace flagstone

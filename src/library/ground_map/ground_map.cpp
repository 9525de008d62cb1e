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
#include "library/ground_map/level_fit.hpp"
#include "library/ground_map/map_tiles.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/tile_bytes.hpp"
#include "library/ground_map/tile_indices.hpp"

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
  /// The scan that was fitted last.
  struct Fitted {
    bool is_current = false;  ///< to the map as it is now
    Pose pose;
    Levelling levelling;
    std::span<const MeasuredHeight> heights;
  };

  Fitted fitted;
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
                      Levelling& levelling) {
  levelling = {};
  builder_->fitted.is_current = false;
  if (Status status = check_scan("ground map", cloud, result, pose); !status.ok()) return status;
  constexpr float max_range_for_level = 30;  // metres
  const std::span<const MeasuredHeight> heights =
      builder_->heights.measure(cloud, result, pose, tiles_->config);
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
  builder_->fitted = {.is_current = true, .pose = pose, .levelling = levelling, .heights = heights};
  return {};
}

Status GroundMap::level(CloudView cloud, const Segmentation& result, const Pose& pose,
                        Levelling& levelling) {
  const ScopedFloatingPointMode mode;
  try {
    if (Status status = fit(cloud, result, pose, levelling); !status.ok()) return status;
    return tiles_->unload();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status GroundMap::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                      Levelling& levelling) {
  const ScopedFloatingPointMode mode;
  try {
    if (Status status = fit(cloud, result, pose, levelling); !status.ok()) return status;
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  return add_fitted();
}

Status GroundMap::add_levelled() {
  if (!builder_->fitted.is_current) {
    return Status(StatusCode::invalid_argument,
                  "ground map: no scan is fitted to the map as it is now (expected a call of level "
                  "before)");
  }
  const ScopedFloatingPointMode mode;
  try {
    if (Status status = tiles_->recall(builder_->fitted.heights); !status.ok()) return status;
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
  return add_fitted();
}

// The tiles of the scan are in memory, as far as the map has them.
Status GroundMap::add_fitted() {
  Tiles& map = *tiles_;
  builder_->fitted.is_current = false;
  const auto& [is_current, pose, levelling, heights] = builder_->fitted;
  try {
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
    builder_->fitted.is_current = false;
    if (tiles_->archive) tiles_->archive->clear();
    return tiles_->unload();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

}  // namespace flagstone

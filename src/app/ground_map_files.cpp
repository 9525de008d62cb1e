// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/ground_map_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>

#include "files/io/atomic_file.hpp"
#include "files/io/cloud.hpp"
#include "files/io/npy.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "tiles are written in memory order");

/// A cell of a tile in a file.
struct CellRecord {
  float height, deviation;
  std::uint32_t last_scan;
  std::uint16_t scans, contradictions;
};

std::array<io::Field, 5> record_fields() {
  using enum io::FieldType;
  return {{{.name = "height", .type = float32},
           {.name = "deviation", .type = float32},
           {.name = "last_scan", .type = uint32},
           {.name = "scans", .type = uint16},
           {.name = "contradictions", .type = uint16}}};
}

Status write_tile(const fs::path& path, const MapTile& tile) {
  constexpr auto width = static_cast<std::size_t>(GroundMap::tile_width);
  const std::string header = io::npy_header(record_fields(), std::array{width, width});
  std::vector<std::byte> file(header.size() + MapTile::cells * sizeof(CellRecord));
  std::memcpy(file.data(), header.data(), header.size());
  std::byte* to = file.data() + header.size();
  for (std::size_t k = 0; k < MapTile::cells; ++k) {
    const CellRecord record{.height = tile.height[k],
                            .deviation = tile.deviation[k],
                            .last_scan = tile.last_scan[k],
                            .scans = tile.scans[k],
                            .contradictions = tile.contradictions[k]};
    std::memcpy(to, &record, sizeof(record));
    to += sizeof(record);
  }
  return io::write_file(path, file);
}

Status unwritable(const fs::path& path, const std::error_code& error) {
  return Status(StatusCode::unwritable, fmt::format("{}: {}", path.string(), error.message()));
}

/// Metres from one corner of a tile to the next.
double tile_size(const GroundMap& map) {
  return map.config().cell * static_cast<double>(GroundMap::tile_width);
}

Json extent_json(const GroundMap& map, TileIndex first, TileIndex last) {
  const double size = tile_size(map);
  return {{"min_x", size * static_cast<double>(first.x)},
          {"min_y", size * static_cast<double>(first.y)},
          {"max_x", size * static_cast<double>(last.x + 1)},
          {"max_y", size * static_cast<double>(last.y + 1)}};
}

/// The smallest and the largest index along both axes. `tiles` must not be empty.
std::pair<TileIndex, TileIndex> limits_of(const std::vector<TileIndex>& tiles) {
  const auto [left, right] = std::ranges::minmax_element(tiles, {}, &TileIndex::x);
  const auto [below, above] = std::ranges::minmax_element(tiles, {}, &TileIndex::y);
  return {{.x = left->x, .y = below->y}, {.x = right->x, .y = above->y}};
}

Json layers_json() {
  const auto layer = [](const char* dtype, const char* values, Json unknown) {
    return Json{{"dtype", dtype}, {"values", values}, {"unknown", std::move(unknown)}};
  };
  return {{"height", layer("float32", "z of the ground at the centre of the cell, metres", "NaN")},
          {"deviation",
           layer("float32", "expected error of the height (standard deviation), metres", "NaN")},
          {"last_scan",
           layer("uint32", "number of the scan that measured the cell last, at least 1", 0)},
          {"scans", layer("uint16", "number of scans that agree on the height", 0)},
          {"contradictions", layer("uint16", "number of scans that measured another height", 0)}};
}

std::string geometry_text(const GroundMap& map, const std::vector<TileIndex>& tiles,
                          const GroundMapFiles& files) {
  const double cell = map.config().cell;
  Json json;
  json["format"] = "flagstone ground map";
  json["version"] = 1;
  json["frame"] = "world frame: the frame of the poses; z up";
  json["units"] = "metres";
  json["cell"] = cell;
  json["tile_width"] = GroundMap::tile_width;
  json["axes"] = {{"rows", "y, from the smallest to the largest"},
                  {"columns", "x, from the smallest to the largest"}};
  json["layers"] = layers_json();
  json["scans"] = map.scans();
  json["cells"] = map.cells();
  json["extent"] = nullptr;
  if (!tiles.empty()) {
    const auto [first, last] = limits_of(tiles);
    json["extent"] = extent_json(map, first, last);
  }
  json["tiles"] = Json::array();
  for (const TileIndex index : tiles) {
    const Json extent = extent_json(map, index, index);
    json["tiles"].push_back(
        {{"file", files.tile(index).filename().string()},
         {"x", index.x},
         {"y", index.y},
         {"extent", extent},
         {"geotransform", {extent["min_x"], cell, 0, extent["min_y"], 0, cell}}});
  }
  return json.dump(1, ' ') + "\n";
}

}  // namespace

fs::path GroundMapFiles::tile(TileIndex index) const {
  return directory / fmt::format("{}_{}.npy", index.x, index.y);
}

Status GroundMapFiles::write(const GroundMap& map) const try {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) return unwritable(directory, error);
  const std::vector<TileIndex> tiles = map.tiles();
  fs::remove(geometry(), error);
  if (error) return unwritable(geometry(), error);
  const auto contents = std::make_unique<MapTile>();
  for (const TileIndex index : tiles) {
    if (!map.read_tile(index, *contents)) continue;
    if (Status status = write_tile(tile(index), *contents); !status.ok()) return status;
  }
  return io::write_file(geometry(), std::string_view(geometry_text(map, tiles, *this)));
} catch (const std::bad_alloc&) {
  return Status(StatusCode::out_of_memory);
}

HeightGrid height_grid(const GroundMap& map, std::size_t max_cells) {
  const std::vector<TileIndex> tiles = map.tiles();
  HeightGrid grid;
  grid.cell = map.config().cell;
  if (tiles.empty()) return grid;
  const auto [first, last] = limits_of(tiles);
  constexpr auto tile_width = static_cast<std::size_t>(GroundMap::tile_width);
  const auto across = static_cast<std::size_t>(last.x - first.x + 1);
  const auto up = static_cast<std::size_t>(last.y - first.y + 1);
  std::size_t merged = 1;  // cells of the map along a side of a cell of the grid
  while (merged < tile_width && std::max(across, up) * tile_width / merged > max_cells) merged *= 2;

  const std::size_t side = tile_width / merged;  // of a tile, in cells of the grid
  grid.columns = across * side;
  grid.cell *= static_cast<double>(merged);
  grid.min_x = tile_size(map) * static_cast<double>(first.x);
  grid.min_y = tile_size(map) * static_cast<double>(first.y);
  grid.heights.assign(grid.columns * up * side, std::numeric_limits<float>::quiet_NaN());
  const auto tile = std::make_unique<MapTile>();
  std::vector<double> sums(side * side);
  std::vector<int> known(side * side);
  for (const TileIndex index : tiles) {
    if (!map.read_tile(index, *tile)) continue;
    std::ranges::fill(sums, 0);
    std::ranges::fill(known, 0);
    for (std::size_t k = 0; k < MapTile::cells; ++k) {
      if (!std::isfinite(tile->height[k])) continue;
      const std::size_t into = k / tile_width / merged * side + k % tile_width / merged;
      sums[into] += double{tile->height[k]};
      ++known[into];
    }
    const std::size_t corner = static_cast<std::size_t>(index.y - first.y) * side * grid.columns +
                               static_cast<std::size_t>(index.x - first.x) * side;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      if (known[k] == 0) continue;
      grid.heights[corner + k / side * grid.columns + k % side] =
          static_cast<float>(sums[k] / known[k]);
    }
  }
  return grid;
}

}  // namespace flagstone::app

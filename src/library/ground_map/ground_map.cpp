// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/ground_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "library/core/setting.hpp"
#include "library/ground_map/level_fit.hpp"
#include "library/ground_map/poses.hpp"
#include "library/ground_map/scan_heights.hpp"
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

class GroundMap::Tiles {
 public:
  GroundMapConfig config;
  CellTiles cells;
  double base = 0;  // z of the sensor in the first scan; stored heights are relative to it
  std::size_t scans = 0;
};

/// Working memory for one scan.
class GroundMap::Builder {
 public:
  ScanHeights heights;
  std::vector<HeightDifference> differences;
  std::vector<double> memory;
};

GroundMap::GroundMap(const GroundMapConfig& config)
    : tiles_(std::make_unique<Tiles>()), builder_(std::make_unique<Builder>()) {
  config.check();
  tiles_->config = config;
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
  builder_->differences.clear();
  for (const MeasuredHeight& measured : heights) {
    if (measured.range > max_range_for_level) continue;
    const MapCell* cell = tiles_->cells.find(measured.cell);
    if (cell == nullptr || cell->best.weight == 0) continue;
    builder_->differences.push_back(
        {.dx = measured.dx,
         .dy = measured.dy,
         .difference = measured.height - tiles_->base - double{cell->best.height}});
  }
  levelling = fit_level(builder_->differences, tiles_->config.max_correction, builder_->memory);
  return {};
}

Status GroundMap::level(CloudView cloud, const Segmentation& result, const Pose& pose,
                        Levelling& levelling) {
  try {
    std::span<const MeasuredHeight> heights;
    return fit(cloud, result, pose, heights, levelling);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status GroundMap::add(CloudView cloud, const Segmentation& result, const Pose& pose,
                      Levelling& levelling) {
  Tiles& map = *tiles_;
  try {
    std::span<const MeasuredHeight> heights;
    if (const Status status = fit(cloud, result, pose, heights, levelling); !status.ok()) {
      return status;
    }
    for (const MeasuredHeight& measured : heights) map.cells.allocate(measured.cell);
    if (map.scans == 0) map.base = pose.position[2];
    ++map.scans;
    for (const MeasuredHeight& measured : heights) {
      const double correction = levelling.offset + levelling.slope_x * double{measured.dx} +
                                levelling.slope_y * double{measured.dy};
      MapCell& cell = *map.cells.find(measured.cell);
      add_height(cell, static_cast<float>(measured.height - map.base - correction),
                 measured.variance);
      cell.last_scan = static_cast<std::uint32_t>(map.scans);
    }
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
  std::array<const MapCell*, 4> cells{};  // null: unknown; x ascending, then y
  double u = 0, v = 0;                    // 0..1 between the centres

  Corners(const CellTiles& tiles, double x, double y, double size) noexcept {
    const double column = x / size - 0.5;
    const double row = y / size - 0.5;
    if (!(std::abs(x) <= max_world_position) || !(std::abs(y) <= max_world_position)) return;
    const auto first_column = static_cast<std::int64_t>(std::floor(column));
    const auto first_row = static_cast<std::int64_t>(std::floor(row));
    u = column - std::floor(column);
    v = row - std::floor(row);
    for (std::size_t k = 0; k < 4; ++k) {
      const MapCell* cell = tiles.find({.x = first_column + static_cast<std::int64_t>(k & 1U),
                                        .y = first_row + static_cast<std::int64_t>(k >> 1U)});
      if (cell != nullptr && cell->best.weight > 0) cells[k] = cell;
    }
  }

  [[nodiscard]] double weight(std::size_t k) const noexcept {
    return ((k & 1U) != 0 ? u : 1 - u) * ((k >> 1U) != 0 ? v : 1 - v);
  }
  [[nodiscard]] double height() const noexcept {
    double sum = 0;
    double known = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (cells[k] == nullptr) continue;
      sum += weight(k) * double{cells[k]->best.height};
      known += weight(k);
    }
    return known > 0.5 ? sum / known : unknown;
  }
  [[nodiscard]] const MapCell* nearest() const noexcept {
    return cells[(u >= 0.5 ? 1U : 0U) + (v >= 0.5 ? 2U : 0U)];
  }
  [[nodiscard]] bool all() const noexcept {
    return std::ranges::all_of(cells, [](const MapCell* cell) { return cell != nullptr; });
  }
};

}  // namespace

double GroundMap::height(double x, double y) const noexcept {
  return tiles_->base + Corners(tiles_->cells, x, y, tiles_->config.cell).height();
}

MapSample GroundMap::at(double x, double y) const noexcept {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const Corners corners(tiles_->cells, x, y, tiles_->config.cell);
  MapSample sample{.height = tiles_->base + corners.height(),
                   .normal = {none, none, none},
                   .slope = none,
                   .deviation = none};
  if (const MapCell* cell = corners.nearest(); cell != nullptr) {
    sample.deviation = std::sqrt(1 / cell->best.weight);
    sample.scans = cell->best.scans;
    sample.contradictions = cell->other.scans;
    sample.age = static_cast<std::uint32_t>(tiles_->scans) - cell->last_scan;
  }
  if (corners.all()) {
    const auto z = [&](std::size_t k) { return double{corners.cells[k]->best.height}; };
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

std::size_t GroundMap::scans() const noexcept { return tiles_->scans; }

std::size_t GroundMap::cells() const noexcept { return tiles_->cells.cells_with_height(); }

std::size_t GroundMap::bytes() const noexcept { return tiles_->cells.bytes(); }

}  // namespace flagstone

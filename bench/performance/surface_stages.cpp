// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Writes the result of each stage of the method `surface` for one simulated scan: points, patches,
// the grids of all levels, cell observations, true ground. bench/surface_figures.py draws these
// files.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <flagstone/segmentation.hpp>
#include <flagstone/surface.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "files/io/atomic_file.hpp"
#include "files/io/npy.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/surface/cell_observations.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/occupied_cells.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::performance {
namespace {

using Json = nlohmann::ordered_json;
using surface::CellLists;

/// Half width and cell size of the grid of the true ground, metres.
constexpr double truth_extent = 24;
constexpr double truth_cell = 0.1;

/// The output directory.
class OutputDirectory {
 public:
  explicit OutputDirectory(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::create_directories(path_);
  }

  void write(const std::string& name, std::span<const float> values,
             std::span<const std::size_t> shape) const {
    check(io::write_npy_file(path_ / (name + ".npy"), values, shape));
  }
  void write(const std::string& name, const Json& json) const {
    check(io::write_file(path_ / (name + ".json"), std::string_view(json.dump(1) + "\n")));
  }

 private:
  static void check(const Status& status) {
    if (!status.ok()) throw std::runtime_error(std::string(status.message()));
  }

  std::filesystem::path path_;
};

/// A grid with its own memory, in the form that src/library/surface uses.
struct OwnGrid {
  explicit OwnGrid(float cell, std::size_t width)
      : heights(width * width + 16),  // find_planes() reads 16 more
        confidences(width * width),
        grid{.cell = cell,
             .width = width,
             .heights = heights.data(),
             .confidences = confidences.data()} {}
  explicit OwnGrid(const GroundSurface::Grid& from) : OwnGrid(from.cell, from.width) {
    std::ranges::copy(from.heights, heights.begin());
    std::ranges::copy(from.confidences, confidences.begin());
  }

  OwnGrid(const OwnGrid&) = delete;
  OwnGrid(OwnGrid&&) = default;  // moving a vector does not move its elements
  OwnGrid& operator=(const OwnGrid&) = delete;
  OwnGrid& operator=(OwnGrid&&) = delete;
  ~OwnGrid() = default;

  std::vector<float> heights, confidences;
  surface::Grid grid;
};

Segmentation segment(const sim::SimulatedScan& scan, SurfaceConfig config, int levels) {
  config.refinement.levels = levels;
  Segmentation result;
  if (!Surface(config).segment(CloudView(scan.xyzi.data(), scan.size(), 4), result).ok()) {
    throw std::runtime_error("not enough memory");
  }
  return result;
}

void write_points(const OutputDirectory& output, const sim::SimulatedScan& scan,
                  const Segmentation& result) {
  std::vector<float> rows;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float* const p = scan.xyzi.data() + 4 * i;
    rows.insert(rows.end(), {p[0], p[1], p[2], static_cast<float>(scan.classes[i]),
                             static_cast<float>(result.labels()[i]), result.heights()[i]});
  }
  output.write("points", rows, std::array{scan.size(), std::size_t{6}});
}

Json patches_json(const Segmentation& result, const SurfaceConfig& config) {
  const float extent =
      std::ceil(config.max_range / surface::block_size) * static_cast<float>(surface::block_size);
  Json patches = Json::array();
  for (const Patch& patch : result.patches()) {
    const float size = patch.zone == 0 ? 4.0f : 8.0f;
    patches.push_back({{"x", (static_cast<float>(patch.sector) + 0.5f) * size - extent},
                       {"y", (static_cast<float>(patch.ring) + 0.5f) * size - extent},
                       {"size", size},
                       {"verdict", to_string(patch.verdict)},
                       {"points", patch.point_count},
                       {"mean", patch.mean},
                       {"normal", patch.normal}});
  }
  return patches;
}

/// The points of a scan packed and sorted by cell, as in the method: the points of a cell of any
/// level are contiguous.
class SortedPoints {
 public:
  SortedPoints(const sim::SimulatedScan& scan, const SurfaceConfig& config) : cells_(config) {
    const CloudView cloud(scan.xyzi.data(), scan.size(), 4);
    points_.reserve(cloud.size(), cells_);
    for (std::size_t i = 0; i < plane_fits::chunk_count(cloud.size()); ++i) {
      points_.read(cloud, i, cells_);
    }
    points_.sort(cloud.size(), cells_);
  }

  [[nodiscard]] const surface::PackedPoint* data() const { return points_.data(); }

  /// The cells of a grid with at least three points.
  [[nodiscard]] CellLists cells_of(const surface::Grid& grid) const {
    const auto along = static_cast<std::uint32_t>(surface::block_size / grid.cell);  // per block
    const auto width = static_cast<std::uint32_t>(grid.width);
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < along * along; ++i) {
      places.push_back(surface::in_z_order[i].row * width + surface::in_z_order[i].column);
    }
    const std::uint32_t blocks = width / along;
    const int first_block = cells_.half_blocks() - static_cast<int>(blocks) / 2;
    std::vector<surface::LevelBlock> level_blocks;
    for (std::uint32_t row = 0; row < blocks; ++row) {
      for (std::uint32_t column = 0; column < blocks; ++column) {
        const surface::CellRange block = cells_.block(first_block + static_cast<int>(column),
                                                      first_block + static_cast<int>(row));
        level_blocks.push_back({.first_cell = block.first,
                                .step = (block.last - block.first) / (along * along),
                                .first_place = (row * width + column) * along});
      }
    }
    CellLists found;
    found.reserve(grid.size());
    found.list(level_blocks, places, points_.begins());
    return found;
  }

 private:
  surface::SquareCells cells_;
  surface::PackedPoints points_;
};

/// The gates of the cells of a level, in units of a packed z.
std::vector<std::int16_t> gates_of(const surface::Grid& grid, const Refinement& settings,
                                   int level) {
  const float gate = settings.gate * std::pow(settings.gate_factor, static_cast<float>(level));
  std::vector<std::int16_t> gates;
  for (std::size_t row = 0; row < grid.width; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      const float range = std::hypot(grid.center(column), grid.center(row));
      gates.push_back(static_cast<std::int16_t>((gate + settings.gate_per_metre * range) *
                                                static_cast<float>(surface::z_per_metre)));
    }
  }
  return gates;
}

/// The surface at the start of a level: the result of the previous levels on the grid of this
/// level.
OwnGrid surface_before(const Segmentation& before, int level) {
  OwnGrid coarse(before.surface().grids().back());
  if (level == 0) return coarse;
  const surface::Level shape = surface::levels[static_cast<std::size_t>(level)];
  OwnGrid fine(shape.cell, static_cast<std::size_t>(2 * shape.reach / shape.cell));
  surface::upsample(coarse.grid, fine.grid);
  return fine;
}

/// Writes the observations of the cells of a level: corrections of the surface of the previous
/// levels.
void write_observations(const OutputDirectory& output, const SortedPoints& points,
                        const Segmentation& before, const SurfaceConfig& config, int level) {
  const OwnGrid below = surface_before(before, level);
  const surface::Grid& grid = below.grid;
  const CellLists lists = points.cells_of(grid);
  std::vector<float> corrections(grid.size());
  std::vector<float> weights(grid.size());
  const Refinement& settings = config.refinement;
  std::vector<std::int32_t> slopes(grid.size() + 16);
  std::vector<std::int32_t> offsets(grid.size() + 16);
  const surface::CellPlanes planes{.slopes = slopes.data(), .offsets = offsets.data()};
  surface::find_planes(grid, -config.sensor_height, planes);
  const std::vector<std::int16_t> gates = gates_of(grid, settings, level);
  const surface::Observations observations{.points = points.data(),
                                           .planes = planes,
                                           .gates = gates.data(),
                                           // The images show the first look only.
                                           .second_look = surface::SecondLook::tilted,
                                           .half_bit = 0,
                                           .widening = 0,
                                           .max_clutter_ratio = settings.max_clutter_ratio,
                                           .lower_bound_weight = settings.lower_bound_weight,
                                           .corrections = corrections.data(),
                                           .weights = weights.data()};
  std::vector<float> occupied(grid.size());
  for (const auto size :
       {surface::CellSize::small, surface::CellSize::medium, surface::CellSize::large}) {
    const surface::OccupiedCells cells = lists.cells(size);
    std::vector<surface::OccupiedCell> unclear(cells.size);
    surface::observe(observations, cells, size, unclear.data());
    for (std::size_t i = 0; i < cells.size; ++i) {
      occupied[cells.places[i]] = static_cast<float>(cells.counts[i]);
    }
  }
  std::vector<float> all = std::move(corrections);
  all.insert(all.end(), weights.begin(), weights.end());
  all.insert(all.end(), occupied.begin(), occupied.end());
  output.write("observed-" + std::to_string(level), all,
               std::array{std::size_t{3}, grid.width, grid.width});
}

void write_truth(const OutputDirectory& output, const sim::Scene& scene, const sim::Frame& pose) {
  const sim::HeightAt height = sim::true_heights(scene.ground(), pose);
  const auto width = static_cast<std::size_t>(std::lround(2 * truth_extent / truth_cell));
  std::vector<float> heights;
  for (std::size_t row = 0; row < width; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const auto metres = [](std::size_t index) {
        return (static_cast<double>(index) + 0.5) * truth_cell - truth_extent;
      };
      heights.push_back(static_cast<float>(height(metres(column), metres(row))));
    }
  }
  output.write("truth", heights, std::array{width, width});
}

void write_stages(const OutputDirectory& output, std::string_view scene_name, std::uint64_t seed) {
  const sim::SceneKind* const kind = sim::find_scene_kind(scene_name);
  if (kind == nullptr) {
    throw std::invalid_argument("unknown scene " + std::string(scene_name) +
                                " (`flagstone simulate --help` lists the scenes)");
  }
  const sim::Drive drive(*kind, Sensor::named("hdl-64e"), sim::drive_seed(seed, 0));
  const sim::Scene scene = drive.scene();
  const sim::SimulatedScan scan = drive.scan(scene, sim::Noise{}, 0);
  const SurfaceConfig config;
  const SortedPoints points(scan, config);

  Json grids = Json::array();
  for (int levels = 0; levels <= config.refinement.levels; ++levels) {
    const Segmentation result = segment(scan, config, levels);
    const GroundSurface::Grid& finest = result.surface().grids().back();
    std::vector<float> all = finest.heights;
    all.insert(all.end(), finest.confidences.begin(), finest.confidences.end());
    output.write("grid-" + std::to_string(levels), all,
                 std::array{std::size_t{2}, finest.width, finest.width});
    grids.push_back({{"cell", finest.cell}, {"width", finest.width}});
    if (levels < config.refinement.levels) {
      write_observations(output, points, result, config, levels);
    } else {
      write_points(output, scan, result);
      output.write("patches", patches_json(result, config));
    }
  }
  write_truth(output, scene, drive.poses().front());
  output.write("stages", Json{{"scene", scene_name},
                              {"seed", seed},
                              {"sensor_height", config.sensor_height},
                              {"lower_bound_weight", config.refinement.lower_bound_weight},
                              {"margin", config.point.margin},
                              {"obstacle_margin", config.point.obstacle_margin},
                              {"obstacle_height", config.point.obstacle_height},
                              {"truth", {{"cell", truth_cell}, {"extent", truth_extent}}},
                              {"grids", grids}});
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  std::uint64_t seed = 0;
  const std::string_view text = argc == 4 ? argv[2] : "";
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (argc != 4 || error != std::errc() || end != text.data() + text.size()) {
    std::fputs("usage: surface_stages SCENE SEED DIR\n", stderr);
    return 2;
  }
  try {
    flagstone::performance::write_stages(flagstone::performance::OutputDirectory(argv[3]), argv[1],
                                         seed);
    return 0;
  } catch (const std::exception& error_of_run) {
    std::fprintf(stderr, "surface_stages: %s\n", error_of_run.what());
    return 1;
  }
}

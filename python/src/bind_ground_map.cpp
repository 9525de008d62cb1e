// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/ground_map_files.hpp"
#include "bindings.hpp"
#include "files/io/map_files.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "run_scans.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

using WritableLabels = nb::ndarray<std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Flags = nb::ndarray<const bool, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Positions = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

class SharedGroundMap : public Shared<GroundMap> {
 public:
  /// `max_memory` in bytes; 0: no limit, and `directory` is not used.
  SharedGroundMap(double cell, double max_range, double window, double max_correction,
                  std::size_t max_memory, const std::string& directory)
      : Shared(GroundMap({.cell = cell,
                          .max_range = max_range,
                          .window = window,
                          .max_correction = max_correction,
                          .max_memory = max_memory},
                         max_memory > 0 ? std::make_shared<io::TileFiles>(directory) : nullptr)) {}

  using Fit = Status (GroundMap::*)(CloudView, const Segmentation&, const Pose&, Levelling&);

  /// Calls `fit`, which is add() or level() of the map.
  nb::tuple fit(Fit fit, nb::handle x, nb::handle y, nb::handle z, const Result& result,
                const PoseRows& pose) {
    GivenScan scan(x, y, z, result, pose);
    Levelling levelling;
    change_with(scan, [&](GroundMap& map, CloudView cloud, const Segmentation& segmentation,
                          const Pose& level_pose) {
      return (map.*fit)(cloud, segmentation, level_pose, levelling);
    });
    return tuple_of(levelling);
  }

  Array<float> heights(nb::handle x, nb::handle y, nb::handle z, const Result& result,
                       const PoseRows& pose, const LevellingTuple& levelling) const {
    GivenScan scan(x, y, z, result, pose);
    const std::size_t count = result.segmentation().labels().size();
    NewArray<float> heights({count});
    read_with(scan, [&](const GroundMap& map, CloudView cloud, const Segmentation& segmentation,
                        const Pose& level_pose) {
      return map.heights(cloud, segmentation, level_pose, levelling_of(levelling),
                         {heights.data(), count});
    });
    return heights.release();
  }

  /// Changes `labels`.
  void relabel(nb::handle x, nb::handle y, nb::handle z, const Result& result, const PoseRows& pose,
               const LevellingTuple& levelling, const WritableLabels& labels) const {
    GivenScan scan(x, y, z, result, pose);
    const std::span written(reinterpret_cast<Label*>(labels.data()), labels.size());
    read_with(scan, [&](const GroundMap& map, CloudView cloud, const Segmentation& segmentation,
                        const Pose& level_pose) {
      return map.relabel(cloud, segmentation, level_pose, levelling_of(levelling), written);
    });
  }
};

std::size_t common_size(const Positions& x, const Positions& y) {
  if (x.size() != y.size()) throw nb::value_error("x and y have different lengths");
  return x.size();
}

Array<double> heights_at(const SharedGroundMap& shared, const Positions& x, const Positions& y) {
  const std::size_t count = common_size(x, y);
  NewArray<double> heights({count});
  shared.read([&](const GroundMap& map) {
    for (std::size_t i = 0; i < count; ++i) {
      heights.data()[i] = map.height(x.data()[i], y.data()[i]);
    }
  });
  return heights.release();
}

/// Height, normal, slope, deviation, scans, contradictions and age at each position.
nb::tuple samples_at(const SharedGroundMap& shared, const Positions& x, const Positions& y) {
  const std::size_t count = common_size(x, y);
  NewArray<double> heights({count});
  NewArray<float> normals({count, 3});
  NewArray<float> slopes({count});
  NewArray<float> deviations({count});
  NewArray<std::uint32_t> scans({count});
  NewArray<std::uint32_t> contradictions({count});
  NewArray<std::uint32_t> ages({count});
  shared.read([&](const GroundMap& map) {
    for (std::size_t i = 0; i < count; ++i) {
      const MapSample at = map.at(x.data()[i], y.data()[i]);
      heights.data()[i] = at.height;
      std::ranges::copy(at.normal, normals.data() + 3 * i);
      slopes.data()[i] = at.slope;
      deviations.data()[i] = at.deviation;
      scans.data()[i] = at.scans;
      contradictions.data()[i] = at.contradictions;
      ages.data()[i] = at.age;
    }
  });
  return nb::make_tuple(heights.release(), normals.release(), slopes.release(),
                        deviations.release(), scans.release(), contradictions.release(),
                        ages.release());
}

nb::list tiles_of(const SharedGroundMap& shared) {
  const std::vector<TileIndex> tiles =
      shared.read([](const GroundMap& map) { return map.tiles(); });
  nb::list list;
  for (const TileIndex index : tiles) list.append(nb::make_tuple(index.x, index.y));
  return list;
}

/// Copies the part of a tile that is within a rectangle of cells.
template <class Copy>
void copy_cells(TileIndex tile, std::int64_t first_column, std::int64_t first_row,
                std::int64_t columns, std::int64_t rows, Copy copy) {
  constexpr std::int64_t width = GroundMap::tile_width;
  const std::int64_t left = tile.x * width - first_column;
  const std::int64_t below = tile.y * width - first_row;
  for (std::int64_t row = std::max<std::int64_t>(0, -below); row < std::min(width, rows - below);
       ++row) {
    for (std::int64_t column = std::max<std::int64_t>(0, -left);
         column < std::min(width, columns - left); ++column) {
      copy(static_cast<std::size_t>(row * width + column),
           static_cast<std::size_t>((below + row) * columns + left + column));
    }
  }
}

/// The layers of the cells from (first_column, first_row), as arrays of (rows, columns): height,
/// deviation, scans, contradictions and last scan.
nb::tuple grid_of(const SharedGroundMap& shared, std::int64_t first_column, std::int64_t first_row,
                  std::int64_t columns, std::int64_t rows) {
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(rows),
                                          static_cast<std::size_t>(columns)};
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  NewArray<float> heights(shape, unknown);
  NewArray<float> deviations(shape, unknown);
  NewArray<std::uint16_t> scans(shape);
  NewArray<std::uint16_t> contradictions(shape);
  NewArray<std::uint32_t> last_scans(shape);
  const auto tile = std::make_unique<MapTile>();
  shared.read([&](const GroundMap& map) {
    for (const TileIndex index : map.tiles()) {
      copy_cells(index, first_column, first_row, columns, rows,
                 [&, is_read = false](std::size_t from, std::size_t to) mutable {
                   if (!is_read) is_read = map.read_tile(index, *tile);
                   heights.data()[to] = tile->height[from];
                   deviations.data()[to] = tile->deviation[from];
                   scans.data()[to] = tile->scans[from];
                   contradictions.data()[to] = tile->contradictions[from];
                   last_scans.data()[to] = tile->last_scan[from];
                 });
    }
  });
  return nb::make_tuple(heights.release(), deviations.release(), scans.release(),
                        contradictions.release(), last_scans.release());
}

class SharedLabelVote : public Shared<LabelVote> {
 public:
  SharedLabelVote(double voxel, double voxel_height, float min_height, float max_height,
                  double max_range, double window)
      : Shared(LabelVote({.voxel = voxel,
                          .voxel_height = voxel_height,
                          .min_height = min_height,
                          .max_height = max_height,
                          .max_range = max_range,
                          .window = window})) {}

  /// `moving`: one per point, true for points that do not vote; or empty.
  void add(nb::handle x, nb::handle y, nb::handle z, const Result& result, const PoseRows& pose,
           const LevellingTuple& levelling, const Flags& moving) {
    GivenScan scan(x, y, z, result, pose);
    const std::span<const bool> excluded(moving.data(), moving.size());
    if (!excluded.empty() && excluded.size() != result.segmentation().labels().size()) {
      throw nb::value_error("moving: has another length than the points");
    }
    change_with(scan, [&](LabelVote& vote, CloudView cloud, const Segmentation& segmentation,
                          const Pose& level_pose) {
      if (excluded.empty()) {
        return vote.add(cloud, segmentation, level_pose, levelling_of(levelling));
      }
      Segmentation without = segmentation;
      for (std::size_t i = 0; i < excluded.size(); ++i) {
        if (excluded[i]) without.mutable_labels()[i] = Label::out_of_range;
      }
      return vote.add(cloud, without, level_pose, levelling_of(levelling));
    });
  }

  Array<std::uint8_t> relabel(nb::handle x, nb::handle y, nb::handle z, const Result& result,
                              const PoseRows& pose, const LevellingTuple& levelling) const {
    GivenScan scan(x, y, z, result, pose);
    NewArray<std::uint8_t> labels({result.segmentation().labels().size()});
    read_with(scan, [&](const LabelVote& vote, CloudView cloud, const Segmentation& segmentation,
                        const Pose& level_pose) {
      return vote.relabel(cloud, segmentation, level_pose, levelling_of(levelling),
                          {reinterpret_cast<Label*>(labels.data()), segmentation.labels().size()});
    });
    return labels.release();
  }
};

}  // namespace

void bind_ground_map(nb::module_& module) {
  nb::class_<SharedGroundMap>(module, "GroundMap")
      .def(nb::init<double, double, double, double, std::size_t, const std::string&>(),
           nb::kw_only(), nb::arg("cell"), nb::arg("max_range"), nb::arg("window"),
           nb::arg("max_correction"), nb::arg("max_memory"), nb::arg("directory"))
      .def(
          "add",
          [](SharedGroundMap& map, nb::handle x, nb::handle y, nb::handle z, const Result& result,
             const PoseRows& pose) { return map.fit(&GroundMap::add, x, y, z, result, pose); },
          nb::arg("x"), nb::arg("y"), nb::arg("z"), nb::arg("result"), nb::arg("pose"),
          nb::sig("def add(self, x: object, y: object, z: object, result: Result, pose: "
                  "numpy.typing.NDArray[numpy.float64]) -> tuple[bool, int, float, float, float]"))
      .def(
          "level",
          [](SharedGroundMap& map, nb::handle x, nb::handle y, nb::handle z, const Result& result,
             const PoseRows& pose) { return map.fit(&GroundMap::level, x, y, z, result, pose); },
          nb::arg("x"), nb::arg("y"), nb::arg("z"), nb::arg("result"), nb::arg("pose"),
          nb::sig("def level(self, x: object, y: object, z: object, result: Result, pose: "
                  "numpy.typing.NDArray[numpy.float64]) -> tuple[bool, int, float, float, float]"))
      .def("heights", &SharedGroundMap::heights, nb::arg("x"), nb::arg("y"), nb::arg("z"),
           nb::arg("result"), nb::arg("pose"), nb::arg("levelling"),
           nb::sig("def heights(self, x: object, y: object, z: object, result: Result, pose: "
                   "numpy.typing.NDArray[numpy.float64], levelling: tuple[bool, int, float, "
                   "float, float]) -> numpy.typing.NDArray[numpy.float32]"))
      .def("relabel", &SharedGroundMap::relabel, nb::arg("x"), nb::arg("y"), nb::arg("z"),
           nb::arg("result"), nb::arg("pose"), nb::arg("levelling"), nb::arg("labels"),
           nb::sig("def relabel(self, x: object, y: object, z: object, result: Result, pose: "
                   "numpy.typing.NDArray[numpy.float64], levelling: tuple[bool, int, float, "
                   "float, float], labels: numpy.typing.NDArray[numpy.uint8]) -> None"))
      .def("height_at", &heights_at, nb::arg("x"), nb::arg("y"),
           nb::sig("def height_at(self, x: numpy.typing.NDArray[numpy.float64], y: "
                   "numpy.typing.NDArray[numpy.float64]) -> numpy.typing.NDArray[numpy.float64]"))
      .def("at", &samples_at, nb::arg("x"), nb::arg("y"),
           nb::sig("def at(self, x: numpy.typing.NDArray[numpy.float64], y: "
                   "numpy.typing.NDArray[numpy.float64]) -> "
                   "tuple[numpy.typing.NDArray[numpy.float64], "
                   "numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32], "
                   "numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.uint32], "
                   "numpy.typing.NDArray[numpy.uint32], numpy.typing.NDArray[numpy.uint32]]"))
      .def("tiles", &tiles_of, nb::sig("def tiles(self) -> list[tuple[int, int]]"))
      .def("grid", &grid_of, nb::arg("first_column"), nb::arg("first_row"), nb::arg("columns"),
           nb::arg("rows"),
           nb::sig("def grid(self, first_column: int, first_row: int, columns: int, rows: int) -> "
                   "tuple[numpy.typing.NDArray[numpy.float32], "
                   "numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.uint16], "
                   "numpy.typing.NDArray[numpy.uint16], numpy.typing.NDArray[numpy.uint32]]"))
      .def(
          "write",
          [](const SharedGroundMap& shared, const std::string& directory) {
            raise_if_failed(shared.read([&](const GroundMap& map) {
              return app::GroundMapFiles{.directory = directory}.write(map);
            }));
          },
          nb::arg("directory"), nb::sig("def write(self, directory: str) -> None"))
      .def("scans",
           [](const SharedGroundMap& shared) {
             return shared.read([](const GroundMap& map) { return map.scans(); });
           })
      .def("cells",
           [](const SharedGroundMap& shared) {
             return shared.read([](const GroundMap& map) { return map.cells(); });
           })
      .def("nbytes",
           [](const SharedGroundMap& shared) {
             return shared.read([](const GroundMap& map) { return map.bytes(); });
           })
      .def("to_bytes", &SharedGroundMap::to_bytes)
      .def("from_bytes", &SharedGroundMap::from_bytes, nb::arg("data"));
  module.attr("ground_map_tile_width") = GroundMap::tile_width;

  nb::class_<SharedLabelVote>(module, "LabelVote")
      .def(nb::init<double, double, float, float, double, double>(), nb::kw_only(),
           nb::arg("voxel"), nb::arg("voxel_height"), nb::arg("min_height"), nb::arg("max_height"),
           nb::arg("max_range"), nb::arg("window"))
      .def("add", &SharedLabelVote::add, nb::arg("x"), nb::arg("y"), nb::arg("z"),
           nb::arg("result"), nb::arg("pose"), nb::arg("levelling"), nb::arg("moving"),
           nb::sig("def add(self, x: object, y: object, z: object, result: Result, pose: "
                   "numpy.typing.NDArray[numpy.float64], levelling: tuple[bool, int, float, "
                   "float, float], moving: numpy.typing.NDArray[numpy.bool_]) -> None"))
      .def("relabel", &SharedLabelVote::relabel, nb::arg("x"), nb::arg("y"), nb::arg("z"),
           nb::arg("result"), nb::arg("pose"), nb::arg("levelling"),
           nb::sig("def relabel(self, x: object, y: object, z: object, result: Result, pose: "
                   "numpy.typing.NDArray[numpy.float64], levelling: tuple[bool, int, float, "
                   "float, float]) -> numpy.typing.NDArray[numpy.uint8]"))
      .def("voxels",
           [](const SharedLabelVote& shared) {
             return shared.read([](const LabelVote& vote) { return vote.voxels(); });
           })
      .def("nbytes",
           [](const SharedLabelVote& shared) {
             return shared.read([](const LabelVote& vote) { return vote.bytes(); });
           })
      .def("to_bytes", &SharedLabelVote::to_bytes)
      .def("from_bytes", &SharedLabelVote::from_bytes, nb::arg("data"));
}

}  // namespace flagstone::python

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "result.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

template <class Number>
using Row = nb::ndarray<nb::numpy, const Number, nb::ndim<1>, nb::c_contig>;
template <class Number>
using Table = nb::ndarray<nb::numpy, const Number, nb::ndim<2>, nb::c_contig>;
using Coordinates = nb::ndarray<nb::numpy, const float, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// A read-only view of memory that the result owns.
template <class Number>
Row<Number> row_of(std::span<const Number> values, nb::handle owner) {
  return Row<Number>(values.data(), {values.size()}, owner);
}

/// Passes the ownership of an array to Python.
template <class Number>
nb::capsule owner_of(Number* numbers) {
  return nb::capsule(numbers, [](void* memory) noexcept { delete[] static_cast<Number*>(memory); });
}

const Result& result_of(nb::handle self) { return nb::cast<const Result&>(self); }

Row<std::uint8_t> labels(nb::handle self) {
  const std::span<const Label> labels = result_of(self).segmentation().labels();
  return row_of<std::uint8_t>({reinterpret_cast<const std::uint8_t*>(labels.data()), labels.size()},
                              self);
}

Row<bool> ground(nb::handle self) {
  const std::span<const std::uint8_t> ground = nb::cast<Result&>(self).ground();
  return row_of<bool>({reinterpret_cast<const bool*>(ground.data()), ground.size()}, self);
}

Row<float> heights(nb::handle self) {
  return row_of<float>(nb::cast<Result&>(self).heights(), self);
}

/// The bytes of the patches; patch_fields() describes their layout.
Row<std::uint8_t> patches(nb::handle self) {
  const std::span<const Patch> patches = result_of(self).segmentation().patches();
  return row_of<std::uint8_t>(
      {reinterpret_cast<const std::uint8_t*>(patches.data()), patches.size_bytes()}, self);
}

nb::tuple counts(const Result& result) {
  nb::list counts;
  for (std::size_t code = 0; code < label_count; ++code) {
    counts.append(result.segmentation().count(static_cast<Label>(code)));
  }
  return nb::tuple(counts);
}

/// Cell size, heights and confidences of every grid.
nb::list grids(nb::handle self) {
  nb::list list;
  for (const GroundSurface::Grid& grid : result_of(self).segmentation().surface().grids()) {
    const std::size_t width = grid.width;
    list.append(nb::make_tuple(grid.cell, Table<float>(grid.heights.data(), {width, width}, self),
                               Table<float>(grid.confidences.data(), {width, width}, self)));
  }
  return list;
}

/// Calls `query(surface, x, y)` for every position, without the GIL.
template <class Query>
Row<float> query_each(const Result& result, const Coordinates& x, const Coordinates& y,
                      Query query) {
  if (x.size() != y.size()) throw nb::value_error("x and y have different lengths");
  const std::size_t count = x.size();
  auto* const values = new float[count == 0 ? 1 : count];
  nb::capsule owner = owner_of(values);
  const GroundSurface& surface = result.segmentation().surface();
  {
    const nb::gil_scoped_release released;
    for (std::size_t i = 0; i < count; ++i) values[i] = query(surface, x.data()[i], y.data()[i]);
  }
  return Row<float>(values, {count}, owner);
}

/// Columns: height, normal x, y, z, slope, confidence. One row per position.
Table<float> ground_at(const Result& result, const Coordinates& x, const Coordinates& y) {
  if (x.size() != y.size()) throw nb::value_error("x and y have different lengths");
  constexpr std::size_t columns = 6;
  const std::size_t count = x.size();
  auto* const values = new float[count == 0 ? 1 : columns * count];
  nb::capsule owner = owner_of(values);
  const GroundSurface& surface = result.segmentation().surface();
  {
    const nb::gil_scoped_release released;
    float* to = values;
    for (std::size_t i = 0; i < count; ++i) {
      const GroundSample at = surface.at(x.data()[i], y.data()[i]);
      *to++ = at.height;
      for (const float component : at.normal) *to++ = component;
      *to++ = at.slope;
      *to++ = at.confidence;
    }
  }
  return Table<float>(values, {count, columns}, owner);
}

/// Name, NumPy format and byte offset of every field of a patch, and the size of a patch.
nb::tuple patch_fields() {
  nb::list fields;
  const auto add = [&](const char* name, const char* format, std::size_t offset) {
    fields.append(nb::make_tuple(name, format, offset));
  };
  add("zone", "u2", offsetof(Patch, zone));
  add("ring", "u2", offsetof(Patch, ring));
  add("sector", "u2", offsetof(Patch, sector));
  add("verdict", "u2", offsetof(Patch, verdict));
  add("point_count", "u4", offsetof(Patch, point_count));
  add("ground_count", "u4", offsetof(Patch, ground_count));
  add("lower_ground_count", "u4", offsetof(Patch, lower_ground_count));
  add("mean", "3f4", offsetof(Patch, mean));
  add("normal", "3f4", offsetof(Patch, normal));
  add("d", "f4", offsetof(Patch, d));
  add("eigenvalues", "3f4", offsetof(Patch, eigenvalues));
  add("uprightness", "f4", offsetof(Patch, uprightness));
  add("elevation", "f4", offsetof(Patch, elevation));
  add("flatness", "f4", offsetof(Patch, flatness));
  add("likelihood", "f4", offsetof(Patch, likelihood));
  add("surface_variable", "f4", offsetof(Patch, surface_variable));
  return nb::make_tuple(fields, sizeof(Patch));
}

nb::tuple tuple_of(const std::array<float, 3>& v) { return nb::make_tuple(v[0], v[1], v[2]); }

/// Sensor height, up direction, origin, scale, and how they were determined, in words.
nb::tuple mount(const Result& result) {
  const Mount& mount = result.mount();
  return nb::make_tuple(mount.sensor_height, tuple_of(mount.up), tuple_of(mount.origin),
                        mount.scale, result.decision());
}

/// Contents of a result, for pickling: the arguments of restored_result().
nb::tuple state(nb::handle self) {
  const Segmentation& segmentation = result_of(self).segmentation();
  nb::object known_heights = nb::none();
  if (segmentation.heights().size() == segmentation.labels().size()) {
    known_heights = nb::cast(heights(self));
  }
  return nb::make_tuple(labels(self), known_heights, patches(self), grids(self),
                        mount(result_of(self)));
}

template <class Number>
using Given = nb::ndarray<const Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using GivenTable = nb::ndarray<const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using GivenGrid = std::tuple<float, GivenTable, GivenTable>;
using GivenMount =
    std::tuple<float, std::array<float, 3>, std::array<float, 3>, float, std::string>;

void restore_labels(const Given<std::uint8_t>& labels, Segmentation& segmentation) {
  const std::span<Label> restored = segmentation.start(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels.data()[i] >= label_count) {
      throw nb::value_error("pickled result: unknown label (expected 0 to 4)");
    }
    restored[i] = static_cast<Label>(labels.data()[i]);
  }
}

GroundSurface::Grid restored_grid(const GivenGrid& given) {
  const auto& [cell, heights, confidences] = given;
  const std::size_t width = heights.shape(0);
  const bool is_square = width >= 2 && width % 2 == 0 && heights.shape(1) == width;
  if (!is_square || confidences.shape(0) != width || confidences.shape(1) != width || !(cell > 0)) {
    throw nb::value_error("pickled result: a grid has an unknown layout");
  }
  return {.cell = cell,
          .width = width,
          .heights = {heights.data(), heights.data() + heights.size()},
          .confidences = {confidences.data(), confidences.data() + confidences.size()}};
}

/// A result from its state(). Throws nb::value_error if the state has the layout of another
/// version.
std::unique_ptr<Result> restored_result(const Given<std::uint8_t>& labels,
                                        const std::optional<Given<float>>& heights,
                                        const Given<std::uint8_t>& patches,
                                        const std::vector<GivenGrid>& grids,
                                        const GivenMount& mount) {
  auto segmentation = std::make_unique<Segmentation>();
  restore_labels(labels, *segmentation);
  if (heights) {
    if (heights->size() != labels.size()) {
      throw nb::value_error("pickled result: the numbers of heights and labels differ");
    }
    std::copy_n(heights->data(), heights->size(), segmentation->start_heights().begin());
  }
  if (patches.size() % sizeof(Patch) != 0) {
    throw nb::value_error("pickled result: written by another version of flagstone");
  }
  segmentation->mutable_patches().resize(patches.size() / sizeof(Patch));
  if (patches.size() != 0) {
    std::memcpy(segmentation->mutable_patches().data(), patches.data(), patches.size());
  }
  if (!grids.empty()) {
    std::vector<GroundSurface::Grid>& to = segmentation->mutable_surface().start();
    for (const GivenGrid& grid : grids) to.push_back(restored_grid(grid));
  }
  segmentation->finish();
  const auto& [height, up, origin, scale, decision] = mount;
  return std::make_unique<Result>(
      std::move(segmentation),
      Mount{.sensor_height = height, .up = up, .origin = origin, .scale = scale}, decision);
}

}  // namespace

void bind_result(nb::module_& module) {
  module.def("patch_fields", &patch_fields,
             nb::sig("def patch_fields() -> tuple[list[tuple[str, str, int]], int]"));
  module.def(
      "restored_result", &restored_result, nb::arg("labels"), nb::arg("heights").none(),
      nb::arg("patches"), nb::arg("grids"), nb::arg("mount"),
      nb::sig("def restored_result(labels: object, heights: object, patches: object, grids: "
              "list[tuple[float, typing.Any, typing.Any]], mount: tuple[float, tuple[float, float, "
              "float], tuple[float, float, float], float, str]) -> Result"));
  nb::class_<Result>(module, "Result")
      .def("state", &state, nb::sig("def state(self) -> tuple[typing.Any, ...]"))
      .def("labels", &labels, nb::sig("def labels(self) -> numpy.typing.NDArray[numpy.uint8]"))
      .def("ground", &ground, nb::sig("def ground(self) -> numpy.typing.NDArray[numpy.bool_]"))
      .def("heights", &heights, nb::sig("def heights(self) -> numpy.typing.NDArray[numpy.float32]"))
      .def("patches", &patches, nb::sig("def patches(self) -> numpy.typing.NDArray[numpy.uint8]"))
      .def("counts", &counts, nb::sig("def counts(self) -> tuple[int, ...]"))
      .def("mount", &mount,
           nb::sig("def mount(self) -> tuple[float, tuple[float, float, float], tuple[float, "
                   "float, float], float, str]"))
      .def("grids", &grids,
           nb::sig("def grids(self) -> list[tuple[float, numpy.typing.NDArray[numpy.float32], "
                   "numpy.typing.NDArray[numpy.float32]]]"))
      .def("extent", [](const Result& result) { return result.segmentation().surface().extent(); })
      .def(
          "height_at",
          [](const Result& result, const Coordinates& x, const Coordinates& y) {
            return query_each(result, x, y,
                              [](const GroundSurface& surface, float at_x, float at_y) {
                                return surface.height(at_x, at_y);
                              });
          },
          nb::arg("x"), nb::arg("y"),
          nb::sig("def height_at(self, x: numpy.typing.NDArray[numpy.float32], y: "
                  "numpy.typing.NDArray[numpy.float32]) -> numpy.typing.NDArray[numpy.float32]"))
      .def(
          "resolution_at",
          [](const Result& result, const Coordinates& x, const Coordinates& y) {
            return query_each(result, x, y,
                              [](const GroundSurface& surface, float at_x, float at_y) {
                                return surface.resolution(at_x, at_y);
                              });
          },
          nb::arg("x"), nb::arg("y"),
          nb::sig("def resolution_at(self, x: numpy.typing.NDArray[numpy.float32], y: "
                  "numpy.typing.NDArray[numpy.float32]) -> numpy.typing.NDArray[numpy.float32]"))
      .def("ground_at", &ground_at, nb::arg("x"), nb::arg("y"),
           nb::sig("def ground_at(self, x: numpy.typing.NDArray[numpy.float32], y: "
                   "numpy.typing.NDArray[numpy.float32]) -> numpy.typing.NDArray[numpy.float32]"));
}

}  // namespace flagstone::python

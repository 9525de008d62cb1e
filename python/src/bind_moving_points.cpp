// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "bindings.hpp"
#include "flagstone/moving_points.hpp"
#include "run_scans.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

/// Objects of the points; points, confidence, min and max of each object.
nb::tuple tuple_of(const MovingMask& mask) {
  NewArray<std::uint32_t> objects_of_points({mask.objects_of_points.size()});
  std::ranges::copy(mask.objects_of_points, objects_of_points.data());
  const std::size_t count = mask.objects.size();
  NewArray<std::uint32_t> points({count});
  NewArray<float> confidences({count});
  NewArray<float> min({count, 3});
  NewArray<float> max({count, 3});
  for (std::size_t k = 0; k < count; ++k) {
    const MovingObject& object = mask.objects[k];
    points.data()[k] = static_cast<std::uint32_t>(object.points);
    confidences.data()[k] = object.confidence;
    std::ranges::copy(object.min, min.data() + 3 * k);
    std::ranges::copy(object.max, max.data() + 3 * k);
  }
  return nb::make_tuple(objects_of_points.release(), points.release(), confidences.release(),
                        min.release(), max.release());
}

class SharedMovingPoints : public Shared<MovingPoints> {
 public:
  SharedMovingPoints(double beam_spacing, double max_range, float min_height, float max_height,
                     double delay, double window)
      : Shared(MovingPoints({.beam_spacing = beam_spacing,
                             .max_range = max_range,
                             .min_height = min_height,
                             .max_height = max_height,
                             .delay = delay,
                             .window = window})) {}

  using Find = Status (MovingPoints::*)(CloudView, const Segmentation&, const Pose&,
                                        const Levelling&, double, MovingMask&);

  /// Calls `find`, which is add() or find().
  nb::tuple find(Find find, nb::handle x, nb::handle y, nb::handle z, const Result& result,
                 const PoseRows& pose, const LevellingTuple& levelling, double time) {
    GivenScan scan(x, y, z, result, pose);
    MovingMask mask;
    change_with(scan, [&](MovingPoints& moving, CloudView cloud, const Segmentation& segmentation,
                          const Pose& level_pose) {
      return (moving.*find)(cloud, segmentation, level_pose, levelling_of(levelling), time, mask);
    });
    return tuple_of(mask);
  }
};

}  // namespace

void bind_moving_points(nb::module_& module) {
  nb::class_<SharedMovingPoints> moving_points(module, "MovingPoints");
  const auto def_find = [&](const char* name, const char* signature,
                            SharedMovingPoints::Find find) {
    moving_points.def(
        name,
        [find](SharedMovingPoints& moving, nb::handle x, nb::handle y, nb::handle z,
               const Result& result, const PoseRows& pose, const LevellingTuple& levelling,
               double time) { return moving.find(find, x, y, z, result, pose, levelling, time); },
        nb::arg("x"), nb::arg("y"), nb::arg("z"), nb::arg("result"), nb::arg("pose"),
        nb::arg("levelling"), nb::arg("time"), nb::sig(signature));
  };
  constexpr auto arguments =
      "(self, x: object, y: object, z: object, result: Result, pose: "
      "numpy.typing.NDArray[numpy.float64], levelling: tuple[bool, int, float, float, float], "
      "time: float) -> tuple[numpy.typing.NDArray[numpy.uint32], "
      "numpy.typing.NDArray[numpy.uint32], numpy.typing.NDArray[numpy.float32], "
      "numpy.typing.NDArray[numpy.float32], numpy.typing.NDArray[numpy.float32]]";
  def_find("add", (std::string("def add") + arguments).c_str(), &MovingPoints::add);
  def_find("find", (std::string("def find") + arguments).c_str(), &MovingPoints::find);
  moving_points
      .def(nb::init<double, double, float, float, double, double>(), nb::kw_only(),
           nb::arg("beam_spacing"), nb::arg("max_range"), nb::arg("min_height"),
           nb::arg("max_height"), nb::arg("delay"), nb::arg("window"))
      .def("beam_spacing",
           [](const SharedMovingPoints& shared) {
             return shared.read([](const MovingPoints& moving) { return moving.beam_spacing(); });
           })
      .def("scans",
           [](const SharedMovingPoints& shared) {
             return shared.read([](const MovingPoints& moving) { return moving.scans(); });
           })
      .def("nbytes",
           [](const SharedMovingPoints& shared) {
             return shared.read([](const MovingPoints& moving) { return moving.bytes(); });
           })
      .def("to_bytes", &SharedMovingPoints::to_bytes)
      .def("from_bytes", &SharedMovingPoints::from_bytes, nb::arg("data"));
}

}  // namespace flagstone::python

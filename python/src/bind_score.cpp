// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/score.hpp"
#include "library/core/did_you_mean.hpp"
#include "points.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

template <class Number>
using Row = nb::ndarray<nb::numpy, const Number, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

const eval::Protocol& protocol_named(const std::string& name) {
  std::vector<std::string_view> names;
  for (const eval::Protocol* protocol : eval::known_protocols()) {
    if (protocol->name == name) return *protocol;
    names.push_back(protocol->name);
  }
  throw std::invalid_argument("protocol: " + no_such("protocol", name, names));
}

nb::tuple score(const Row<std::uint8_t>& labels, const Row<std::uint32_t>& classes, nb::handle x,
                nb::handle y, nb::handle z, const std::string& protocol_name) {
  const eval::Protocol& protocol = protocol_named(protocol_name);
  const Points points(x, y, z);
  std::vector<float> copy;
  const CloudView cloud = points.view(copy);
  if (labels.size() != cloud.size() || classes.size() != cloud.size()) {
    throw std::invalid_argument(fmt::format(
        "{} labels and {} classes do not match {} points (expected one of each per point)",
        labels.size(), classes.size(), cloud.size()));
  }
  eval::Confusion confusion;
  {
    const nb::gil_scoped_release released;
    const std::vector<Truth> truth =
        eval::truth_of(protocol, cloud, {classes.data(), classes.size()});
    confusion =
        eval::compare({reinterpret_cast<const Label*>(labels.data()), labels.size()}, truth);
  }
  return nb::make_tuple(confusion.true_positives, confusion.false_positives,
                        confusion.false_negatives, confusion.true_negatives);
}

}  // namespace

void bind_score(nb::module_& module) {
  module.def("score", &score, nb::arg("labels"), nb::arg("classes"), nb::arg("x"), nb::arg("y"),
             nb::arg("z"), nb::arg("protocol"),
             nb::sig("def score(labels: numpy.typing.NDArray[numpy.uint8], classes: "
                     "numpy.typing.NDArray[numpy.uint32], x: object, y: object, z: object, "
                     "protocol: str) -> tuple[float, float, float, float]"));
}

}  // namespace flagstone::python

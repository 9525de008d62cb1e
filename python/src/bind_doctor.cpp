// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <string>
#include <utility>

#include "app/doctor_report.hpp"
#include "bindings.hpp"
#include "files/io/cloud.hpp"
#include "method.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

/// x, y, z or x, y, z, intensity, ring of every point.
using Columns = nb::ndarray<nb::numpy, const float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

app::ScanExaminer examiner_of(const std::string& method, const Settings& settings) {
  const config::MethodChoice choice = {
      .methods = {method}, .settings = {{.table = value_of(settings)}}, .option_prefix = ""};
  config::ResolvedMethod resolved = config::resolve_one(choice);
  return {resolved.name, resolved.config};
}

void examine(app::ScanExaminer& examiner, const std::string& name, const Columns& columns) {
  Status status;
  {
    const nb::gil_scoped_release released;
    io::Cloud cloud;
    status = io::Cloud::from_floats({columns.data(), columns.size()}, columns.shape(1), cloud);
    if (status.ok()) examiner.examine(name, cloud);
  }
  raise_if_failed(status);
}

/// The report as text, with the recommended settings below it, as JSON and as TOML; the number of
/// scans; whether nothing must be fixed.
nb::tuple report_of(const app::ScanExaminer& examiner, bool bold) {
  const app::DoctorReport report = examiner.report();
  return nb::make_tuple(app::text_of(report, bold), app::json_of(report), app::toml_of(report),
                        report.files.size(), report.ok());
}

}  // namespace

void bind_doctor(nb::module_& module) {
  nb::class_<app::ScanExaminer>(module, "ScanExaminer")
      .def(nb::new_(&examiner_of), nb::arg("method"), nb::arg("settings"))
      .def("examine", &examine, nb::arg("name"), nb::arg("columns"),
           nb::sig("def examine(self, name: str, columns: numpy.typing.NDArray[numpy.float32]) -> "
                   "None"))
      .def("fail", &app::ScanExaminer::fail, nb::arg("name"), nb::arg("error"))
      .def("report", &report_of, nb::arg("bold"),
           nb::sig("def report(self, bold: bool) -> tuple[str, str, str, int, bool]"));
}

}  // namespace flagstone::python

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "bindings.hpp"
#include "flagstone/version.hpp"

namespace flagstone::python {

void raise_if_failed(const Status& status) {
  if (status.ok()) return;
  const char* const message = status.message().c_str();
  switch (status.code()) {
    case StatusCode::out_of_memory: PyErr_SetString(PyExc_MemoryError, message); break;
    case StatusCode::not_found: PyErr_SetString(PyExc_FileNotFoundError, message); break;
    case StatusCode::unreadable:
    case StatusCode::unwritable: PyErr_SetString(PyExc_OSError, message); break;
    default: PyErr_SetString(PyExc_ValueError, message); break;
  }
  throw nanobind::python_error();
}

}  // namespace flagstone::python

NB_MODULE(_core, module) {
  using namespace flagstone::python;
  nanobind::set_leak_warnings(false);  // a segmenter in a global variable is not a leak
  module.attr("version") = FLAGSTONE_VERSION;
  bind_result(module);
  bind_segmenter(module);
  bind_known(module);
  bind_files(module);
  bind_ros(module);
  bind_score(module);
  bind_runs(module);
  bind_doctor(module);
  bind_ground_map(module);
  bind_moving_points(module);
}

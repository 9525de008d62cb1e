// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include "flagstone/status.hpp"

/// Contents of the module `flagstone._core`, one function per file. The public API and its
/// documentation are in the Python files of the package.
namespace flagstone::python {

void bind_segmenter(nanobind::module_& module);
void bind_result(nanobind::module_& module);
void bind_known(nanobind::module_& module);
void bind_files(nanobind::module_& module);
void bind_ros(nanobind::module_& module);
void bind_score(nanobind::module_& module);
void bind_runs(nanobind::module_& module);
void bind_doctor(nanobind::module_& module);
void bind_ground_map(nanobind::module_& module);
void bind_moving_points(nanobind::module_& module);

/// Throws the Python exception for a failed status: MemoryError, ValueError, FileNotFoundError or
/// OSError.
void raise_if_failed(const Status& status);

}  // namespace flagstone::python

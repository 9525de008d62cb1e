// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include "flagstone/status.hpp"

/// What the module `flagstone._core` holds, a function a file. What people use, and its
/// documentation, is in the package's Python files.
namespace flagstone::python {

void bind_segmenter(nanobind::module_& module);
void bind_result(nanobind::module_& module);
void bind_known(nanobind::module_& module);
void bind_files(nanobind::module_& module);
void bind_score(nanobind::module_& module);
void bind_runs(nanobind::module_& module);

/// Does nothing if all went well; else throws what Python shows as MemoryError, ValueError, or for
/// files FileNotFoundError or OSError.
void raise_if_failed(const Status& status);

}  // namespace flagstone::python

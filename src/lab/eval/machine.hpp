// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace flagstone::eval {

/// What figures were measured on: the processor's name as the system gives it, and how many cores
/// there are to use.
std::string machine_name();

/// The date, UTC, as 2026-11-21.
std::string today();

}  // namespace flagstone::eval

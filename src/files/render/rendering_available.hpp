// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/status.hpp"

namespace flagstone::render {

/// Ok where this build has Cairo. Without it, what to do about it; that is also what each function
/// here that draws then returns, writing nothing.
[[nodiscard]] Status rendering_available();

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/status.hpp"

namespace flagstone::render {

/// Ok if this build has Cairo. Otherwise an error with the packages to install; every drawing
/// function then returns the same error and writes nothing.
[[nodiscard]] Status rendering_available();

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "render/canvas.hpp"
#include "render/layout.hpp"

namespace flagstone::render {

/// Writes title and subtitle above the panel.
void draw_heading(const Canvas& canvas, const Layout& layout, std::string_view title,
                  std::string_view subtitle);

}  // namespace flagstone::render

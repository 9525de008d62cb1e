// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "files/render/canvas.hpp"

namespace flagstone::render {

/// Writes title and subtitle into `heading`, above the panel.
void draw_heading(const Canvas& canvas, const Rectangle& heading, double unit,
                  std::string_view title, std::string_view subtitle);

}  // namespace flagstone::render

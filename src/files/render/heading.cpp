// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/heading.hpp"

#include "files/render/text.hpp"

namespace flagstone::render {

void draw_heading(const Canvas& canvas, const Rectangle& heading, double unit,
                  std::string_view title, std::string_view subtitle) {
  cairo_t* context = canvas.context();
  const auto& [x, y, width, height] = heading;
  const Font title_font{.size = 36 * unit, .bold = true, .color = text_color};
  const Font subtitle_font{.size = 26 * unit, .bold = false, .color = muted_text_color};
  draw_text(context, x, y + 28 * unit, fitted(context, title, title_font, width), title_font);
  draw_text(context, x, y + 66 * unit, fitted(context, subtitle, subtitle_font, width),
            subtitle_font);
}

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace flagstone::render {

/// An sRGB colour, each part 0 to 255.
struct Color {
  constexpr Color(std::uint8_t red_part, std::uint8_t green_part, std::uint8_t blue_part) noexcept
      : red(red_part), green(green_part), blue(blue_part) {}

  std::uint8_t red, green, blue;
};

// A dark panel, since the yellow and cyan of the paper's figures are too pale to read on white.
inline constexpr Color page_color{255, 255, 255};
inline constexpr Color panel_color{16, 19, 24};
inline constexpr Color text_color{24, 28, 34};
inline constexpr Color muted_text_color{92, 100, 110};
inline constexpr Color panel_text_color{232, 236, 240};
inline constexpr Color range_ring_color{150, 160, 172};
inline constexpr Color zone_line_color{235, 240, 245};
inline constexpr Color contour_color{88, 58, 38};

/// What is written and drawn on top of a panel: its colour and that of the edge or box around it.
struct PanelInk {
  Color ink, backing;
};
inline constexpr PanelInk dark_panel_ink{panel_text_color, panel_color};
inline constexpr PanelInk map_ink{text_color, page_color};

}  // namespace flagstone::render

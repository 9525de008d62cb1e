// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace flagstone::app {

/// Where wrapped text goes, in columns.
struct TextBox {
  std::size_t column = 0;  ///< where the first line begins
  std::size_t indent = 0;  ///< where the other lines begin
  std::size_t width = 100;
};

/// `text` with a line break and spaces instead of a space wherever a line would exceed the width.
/// The first line is not indented. Words are never broken.
std::string wrapped(std::string_view text, const TextBox& box);

}  // namespace flagstone::app

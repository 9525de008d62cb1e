// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/wrapped.hpp"

#include <algorithm>

namespace flagstone::app {

std::string wrapped(std::string_view text, const TextBox& box) {
  std::string lines;
  std::size_t column = box.column;
  bool is_first = true;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (!is_first && column + 1 + word.size() > box.width) {
      lines += '\n' + std::string(box.indent, ' ');
      column = box.indent;
    } else if (!is_first) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    is_first = false;
  }
  return lines;
}

}  // namespace flagstone::app

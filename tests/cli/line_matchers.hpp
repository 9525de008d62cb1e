// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

namespace flagstone::cli {

MATCHER(is_one_line, "is one line that starts with 'flagstone: '") {
  const std::string& text = arg;
  return text.starts_with("flagstone: ") && text.ends_with('\n') &&
         std::ranges::count(text, '\n') == 1;
}

/// One line on standard error that contains `part`.
inline auto is_one_line_with(const std::string& part) {
  return ::testing::AllOf(is_one_line(), ::testing::HasSubstr(part));
}

}  // namespace flagstone::cli

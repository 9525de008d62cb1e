// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Reads `points` lines of numbers, a point a line with all its fields in order, from `text` at
/// `offset`, which moves behind the last line. Empty lines are skipped. `nan` and `inf` are numbers
/// of float fields. A number takes two bytes of text at least, so a header that announces more
/// points than that is refused before anything is allocated. bad_file.
Status read_ascii_rows(std::string_view text, std::span<const Field> fields, std::size_t stride,
                       std::size_t points, std::size_t& offset, std::vector<std::byte>& rows);

/// Moves `offset` behind `lines` lines that are not empty. bad_file where there are fewer.
Status skip_lines(std::string_view text, std::size_t lines, std::size_t& offset);

/// bad_file where `text` holds more than blanks from `offset` on: points the header does not count.
Status check_nothing_follows(std::string_view text, std::size_t offset, std::size_t points);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

// Rows are kept as little-endian bytes and read as the machine's own numbers.
static_assert(std::endian::native == std::endian::little, "flagstone reads on little-endian only");

/// Calls `work.template operator()<T>()` with the C++ type of `type`.
template <class Work>
decltype(auto) visit_type(FieldType type, Work&& work) {
  switch (type) {
    case FieldType::int8: return work.template operator()<std::int8_t>();
    case FieldType::uint8: return work.template operator()<std::uint8_t>();
    case FieldType::int16: return work.template operator()<std::int16_t>();
    case FieldType::uint16: return work.template operator()<std::uint16_t>();
    case FieldType::int32: return work.template operator()<std::int32_t>();
    case FieldType::uint32: return work.template operator()<std::uint32_t>();
    case FieldType::int64: return work.template operator()<std::int64_t>();
    case FieldType::uint64: return work.template operator()<std::uint64_t>();
    case FieldType::float32: return work.template operator()<float>();
    case FieldType::float64: break;
  }
  return work.template operator()<double>();
}

/// The number at an address of any alignment.
template <class T>
T load(const std::byte* from) noexcept {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// Stores a number at an address of any alignment.
template <class T>
void store(std::byte* to, T value) noexcept {
  std::memcpy(to, &value, sizeof value);
}

/// Sets the fields' offsets one behind the other, and `stride` to the length of a row. What Cloud
/// demands of fields is checked here: invalid_argument with the reason.
Status lay_out(std::span<Field> fields, std::size_t& stride);

/// How many numbers a row has.
std::size_t numbers_in_row(std::span<const Field> fields) noexcept;

/// Copies `count` items of `size` bytes from places `from_stride` apart to places `to_stride`
/// apart.
void copy_column(const std::byte* from, std::size_t from_stride, std::byte* to,
                 std::size_t to_stride, std::size_t size, std::size_t count) noexcept;

/// Turns columns (all points' first field, then all points' second, ...) into rows.
std::vector<std::byte> rows_from_columns(std::span<const std::byte> columns,
                                         std::span<const Field> fields, std::size_t stride);

/// Reverses the bytes of every number of `field` in all rows.
void swap_bytes(std::span<std::byte> rows, std::size_t stride, const Field& field) noexcept;

/// Whether a file's bytes from `offset` on can be the `points` rows of `stride` bytes its header
/// announces: bad_file where there are fewer, and where a row or more is left over if nothing else
/// may follow them (`points_are_last`).
Status check_binary_rows(std::span<const std::byte> bytes, std::size_t offset, std::size_t points,
                         std::size_t stride, bool points_are_last);

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

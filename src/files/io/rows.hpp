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

// Rows are little-endian bytes, which are read as numbers without conversion.
static_assert(std::endian::native == std::endian::little, "flagstone requires a little-endian CPU");

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

/// Loads a number from an address of any alignment.
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

/// Sets the offsets of the fields so that they are packed, and `stride` to the length of a row in
/// bytes. invalid_argument with the reason if the fields break a rule of Cloud::from_rows().
Status lay_out(std::span<Field> fields, std::size_t& stride);

/// The number of numbers in a row.
std::size_t numbers_in_row(std::span<const Field> fields) noexcept;

/// Copies `count` items of `size` bytes from addresses `from_stride` bytes apart to addresses
/// `to_stride` bytes apart.
void copy_column(const std::byte* from, std::size_t from_stride, std::byte* to,
                 std::size_t to_stride, std::size_t size, std::size_t count) noexcept;

/// Converts columns (the first field of all points, then the second field of all points, ...) to
/// rows.
std::vector<std::byte> rows_from_columns(std::span<const std::byte> columns,
                                         std::span<const Field> fields, std::size_t stride);

/// Reverses the bytes of every number of `field` in all rows.
void swap_bytes(std::span<std::byte> rows, std::size_t stride, const Field& field) noexcept;

/// Checks that the file contains, from `offset`, the `points` rows of `stride` bytes that its
/// header specifies. bad_file if there are fewer, or if nothing may follow the points
/// (`points_are_last`) and at least one row is left over.
Status check_binary_rows(std::span<const std::byte> bytes, std::size_t offset, std::size_t points,
                         std::size_t stride, bool points_are_last);

/// Reads `points` lines of numbers, one point per line with all fields in order, from `text` at
/// `offset`, which moves past the last line. Skips empty lines. Float fields may be `nan` or `inf`.
/// A number takes at least two bytes of text: if the header specifies more points than fit, this
/// fails before it allocates memory. bad_file.
Status read_ascii_rows(std::string_view text, std::span<const Field> fields, std::size_t stride,
                       std::size_t points, std::size_t& offset, std::vector<std::byte>& rows);

/// Moves `offset` past `lines` non-empty lines. bad_file if there are fewer.
Status skip_lines(std::string_view text, std::size_t lines, std::size_t& offset);

/// bad_file if `text` contains anything but blanks from `offset`: points that the header does not
/// count.
Status check_nothing_follows(std::string_view text, std::size_t offset, std::size_t points);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

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

}  // namespace flagstone::io

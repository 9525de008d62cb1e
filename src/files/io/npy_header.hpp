// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// A field of an array's items; plain arrays have one without a name.
struct NpyField {
  Field field;
  bool big_endian = false;
};

/// What the header of a NumPy file says, not checked against the file's size.
struct NpyHeader {
  std::vector<NpyField> fields;
  bool is_structured = false;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t descr_offset = 0;  ///< where the items are described
  std::size_t shape_offset = 0;  ///< where the shape is
  std::size_t size = 0;          ///< bytes of the header: where the items begin
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_npy_header(std::string_view text, NpyHeader& out);

/// The header of an array of `count` records.
std::string npy_header(std::span<const Field> fields, std::size_t count);

/// The header of a plain array of numbers, by rows: as many along each dimension as `shape` says.
std::string npy_header(FieldType type, std::span<const std::size_t> shape);

/// The same with one dimension.
std::string npy_header(FieldType type, std::size_t count);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
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
  bool boolean = false;  ///< read as uint8; not a coordinate
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

/// Reads a NumPy array, format 1, 2 or 3, either N x 3 or more numbers of any integer or float type
/// (C or Fortran order), or N records with x, y and z among their fields; little or big endian.
/// bad_file with the byte offset and the reason, out_of_memory. Never throws; `out` is only changed
/// on success.
Status read_npy(std::span<const std::byte> bytes, Cloud& out);

/// Writes NumPy format 1.0 (2.0 where the header is long): N records with every field.
/// out_of_memory. Never throws.
Status write_npy(const Cloud& cloud, std::vector<std::byte>& out);

/// Writes a file of numbers, by rows, as many along each dimension as `shape` says: NumPy
/// format 1.0, float32. The file is there whole or not at all. invalid_argument where `values` are
/// not as many as the shape says, unwritable, out_of_memory. Never throws.
Status write_npy_file(const std::filesystem::path& path, std::span<const float> values,
                      std::span<const std::size_t> shape);

/// Reads one height a point, metres, as write_npy_file() writes them: a NumPy array, N x float32;
/// NaN where none is known. `expected_points` is the size of the scan the file belongs to; any
/// other number of heights is an error that names both. not_found, unreadable, bad_file,
/// out_of_memory. Never throws; `heights` is only changed on success.
Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights);

/// Bytes of such a file. Throws std::bad_alloc.
std::size_t height_file_size(std::size_t points);

}  // namespace flagstone::io

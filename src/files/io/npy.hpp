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

/// A field of the items of an array. Plain arrays have one field without a name.
struct NpyField {
  Field field;
  bool big_endian = false;
  bool boolean = false;  ///< read as uint8; not a coordinate
};

/// The contents of a NumPy header, not yet checked against the size of the file.
struct NpyHeader {
  std::vector<NpyField> fields;
  bool is_structured = false;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::size_t descr_offset = 0;  ///< byte at which the item type begins
  std::size_t shape_offset = 0;  ///< byte at which the shape begins
  std::size_t size = 0;          ///< bytes of the header; the items follow
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_npy_header(std::string_view text, NpyHeader& out);

/// The header of a structured array of records of this shape in C order.
std::string npy_header(std::span<const Field> fields, std::span<const std::size_t> shape);

/// The header of a one-dimensional structured array of `count` records.
std::string npy_header(std::span<const Field> fields, std::size_t count);

/// The header of a plain array of this shape in C order.
std::string npy_header(FieldType type, std::span<const std::size_t> shape);

/// The header of a plain one-dimensional array of `count` numbers.
std::string npy_header(FieldType type, std::size_t count);

/// Reads a point cloud from a NumPy file of format 1, 2 or 3, little or big endian. The array is
/// either N x 3 or more integers or floats (C or Fortran order), or N records with the fields x, y
/// and z. bad_file with the byte offset and the reason, out_of_memory. Never throws; changes `out`
/// only on success.
Status read_npy(std::span<const std::byte> bytes, Cloud& out);

/// Writes the cloud as N records with every field, in NumPy format 1.0 (2.0 if the header is too
/// long). out_of_memory. Never throws.
Status write_npy(const Cloud& cloud, std::vector<std::byte>& out);

/// Writes a float32 array of this shape, in C order, as a file of NumPy format 1.0. The file is
/// written atomically. invalid_argument if the number of `values` does not match the shape,
/// unwritable, out_of_memory. Never throws.
Status write_npy_file(const std::filesystem::path& path, std::span<const float> values,
                      std::span<const std::size_t> shape);

/// Reads one height per point from a one-dimensional float32 array, as written by write_npy_file():
/// metres, NaN if unknown. `expected_points` is the size of the scan that the file belongs to; any
/// other number of heights is an error that reports both numbers. not_found, unreadable, bad_file,
/// out_of_memory. Never throws; changes `heights` only on success.
Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights);

/// Size in bytes of a file of `points` heights. Throws std::bad_alloc.
std::size_t height_file_size(std::size_t points);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// How the numbers of a PLY file are stored.
enum class PlyData { ascii, binary_little_endian, binary_big_endian };

/// One property of an element: a number, or a list of them with its length before it.
struct PlyProperty {
  std::string_view name;  ///< in the text the header was read from
  FieldType type = FieldType::float32;
  std::optional<FieldType> length_type;  ///< of a list
  std::size_t offset = 0;                ///< of its line in the file
};

/// A kind of element, `count` of which are in the file.
struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t offset = 0;  ///< of its line in the file
};

/// What the header of a PLY file says, not checked against the file's size.
struct PlyHeader {
  PlyData data = PlyData::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes of the header: where the first element begins
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_ply_header(std::string_view text, PlyHeader& out);

}  // namespace flagstone::io

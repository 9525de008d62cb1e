// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// How the points of a PCD file are stored.
enum class PcdData { ascii, binary, binary_compressed };

/// What the header of a PCD file says, checked in itself but not against the file's size.
struct PcdHeader {
  std::vector<Field> fields;
  std::size_t stride = 0;
  std::size_t points = 0;
  PcdData data = PcdData::ascii;
  std::size_t size = 0;  ///< bytes of the header: where the points begin
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_pcd_header(std::string_view text, PcdHeader& out);

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/npy.hpp"

namespace flagstone::io {

/// A NumPy array of float32 in C order.
struct FloatArray {
  std::vector<std::size_t> shape;
  std::vector<float> values;
};

/// Reads the array of a file. If the file is not an array, the test fails and the shape is empty.
inline FloatArray float_array_of(const std::filesystem::path& path) {
  const std::string file = contents_of(path);
  NpyHeader header;
  const Status status = read_npy_header(file, header);
  EXPECT_TRUE(status.ok()) << path << ": " << status.message();
  if (!status.ok()) return {};
  EXPECT_EQ(header.fields.front().field.type, FieldType::float32);
  EXPECT_FALSE(header.fortran_order);
  FloatArray array{.shape = header.shape, .values = {}};
  array.values.resize((file.size() - header.size) / sizeof(float));
  std::memcpy(array.values.data(), file.data() + header.size, array.values.size() * sizeof(float));
  return array;
}

}  // namespace flagstone::io

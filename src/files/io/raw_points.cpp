// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/raw_points.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/row_layout.hpp"

namespace flagstone::io {

namespace {

/// Are these whole points?
Status check_size(std::size_t size, std::size_t floats_per_point) {
  if (floats_per_point < 3 || floats_per_point > max_fields) {
    return invalid("{} floats a point (allowed: 3 to {}; set it with --columns)", floats_per_point,
                   max_fields);
  }
  const std::size_t stride = floats_per_point * sizeof(float);
  const std::size_t rest = size % stride;
  if (rest == 0) return {};
  return bad_byte(size - rest,
                  "{} bytes are not a whole number of points of {} floats, {} bytes each (say "
                  "how many floats a point has with --columns, or the file is cut off)",
                  size, floats_per_point, stride);
}

}  // namespace

Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (Status status = check_size(bytes.size(), floats_per_point); !status.ok()) return status;
    return adopt_raw_points({bytes.begin(), bytes.end()}, floats_per_point, out);
  });
}

Status adopt_raw_points(std::vector<std::byte> bytes, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (Status status = check_size(bytes.size(), floats_per_point); !status.ok()) return status;
    return Cloud::from_rows(unnamed_fields(floats_per_point, FieldType::float32), std::move(bytes),
                            out);
  });
}

Status write_raw_points(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    const auto fields = cloud.fields();
    for (const Field& field : fields) {
      if (field.type != FieldType::float32) {
        return invalid("field {} is {}: raw files hold float32 only (write PCD, PLY or NPY)",
                       quote(field.name), to_string(field.type));
      }
    }
    constexpr std::array<std::string_view, 3> first_three{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (fields.size() <= i || fields[i].name != first_three[i]) {
        return invalid("raw files need x, y and z as first fields (write PCD, PLY or NPY)");
      }
    }
    out.assign(cloud.bytes().begin(), cloud.bytes().end());
    return Status();
  });
}

}  // namespace flagstone::io

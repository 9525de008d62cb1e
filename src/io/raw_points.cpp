// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "io/raw_points.hpp"

#include <array>
#include <string_view>

#include "io/message.hpp"
#include "io/row_layout.hpp"

namespace flagstone::io {

Status read_raw_points(std::span<const std::byte> bytes, std::size_t floats_per_point, Cloud& out) {
  return within_memory([&] {
    if (floats_per_point < 3 || floats_per_point > max_fields) {
      return invalid("{} floats a point (allowed: 3 to {}; set it with --columns)",
                     floats_per_point, max_fields);
    }
    const std::size_t stride = floats_per_point * sizeof(float);
    if (const std::size_t rest = bytes.size() % stride; rest != 0) {
      return bad_byte(bytes.size() - rest,
                      "{} bytes are not a whole number of points of {} floats, {} bytes each (say "
                      "how many floats a point has with --columns, or the file is cut off)",
                      bytes.size(), floats_per_point, stride);
    }
    return Cloud::from_rows(unnamed_fields(floats_per_point, FieldType::float32),
                            {bytes.begin(), bytes.end()}, out);
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

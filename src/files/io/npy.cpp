// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/npy.hpp"

#include <fmt/ranges.h>

#include <string>
#include <utility>

#include "files/io/atomic_file.hpp"
#include "files/io/binary_rows.hpp"
#include "files/io/message.hpp"
#include "files/io/npy_header.hpp"
#include "files/io/row_layout.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

/// The array as a table: as many points as its first dimension says.
struct Table {
  std::vector<Field> fields;
  std::size_t stride = 0;
  std::size_t points = 0;
  bool by_columns = false;
};

Status table_of(const NpyHeader& header, Table& out) {
  const auto& shape = header.shape;
  if (header.is_structured) {
    if (shape.size() != 1) {
      return bad_byte(header.shape_offset, "an array of records has {} dimensions (one is allowed)",
                      shape.size());
    }
    for (const NpyField& field : header.fields) out.fields.push_back(field.field);
  } else {
    if (shape.size() != 2 || shape[1] < 3 || shape[1] > max_fields) {
      return bad_byte(header.shape_offset,
                      "the array is not N x 3 to N x {} (a point a row, x, y and z first)",
                      max_fields);
    }
    out.fields = unnamed_fields(shape[1], header.fields[0].field.type);
  }
  if (const Status status = lay_out(out.fields, out.stride); !status.ok()) {
    return bad_byte(header.descr_offset, "{}", status.message());
  }
  out.points = shape[0];
  out.by_columns = header.fortran_order && !header.is_structured;
  return {};
}

bool is_big_endian(const NpyHeader& header, std::size_t field) {
  return header.fields[header.is_structured ? field : 0].big_endian;
}

}  // namespace

Status read_npy(std::span<const std::byte> bytes, Cloud& out) {
  return within_memory([&] {
    NpyHeader header;
    if (Status status = read_npy_header(as_text(bytes), header); !status.ok()) return status;
    Table table;
    if (Status status = table_of(header, table); !status.ok()) return status;
    Status status = check_binary_rows(bytes, header.size, table.points, table.stride, true);
    if (!status.ok()) return status;
    const auto data = bytes.subspan(header.size, table.points * table.stride);
    std::vector<std::byte> rows = table.by_columns
                                      ? rows_from_columns(data, table.fields, table.stride)
                                      : std::vector<std::byte>(data.begin(), data.end());
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
      if (is_big_endian(header, i)) swap_bytes(rows, table.stride, table.fields[i]);
    }
    return Cloud::from_rows(std::move(table.fields), std::move(rows), out);
  });
}

Status write_npy(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    const std::string header = npy_header(cloud.fields(), cloud.size());
    const auto head = std::as_bytes(std::span(header));
    std::vector<std::byte> file;
    file.reserve(head.size() + cloud.bytes().size());
    file.assign(head.begin(), head.end());
    file.insert(file.end(), cloud.bytes().begin(), cloud.bytes().end());
    out = std::move(file);
    return Status();
  });
}

Status write_npy_file(const std::filesystem::path& path, std::span<const float> values,
                      std::span<const std::size_t> shape) {
  std::vector<std::byte> file;
  Status status = within_memory([&] {
    std::size_t count = 1;
    for (const std::size_t length : shape) count *= length;
    if (count != values.size()) {
      return invalid("{} numbers for an array of {}", values.size(), fmt::join(shape, " x "));
    }
    const std::string header = npy_header(FieldType::float32, shape);
    const auto head = std::as_bytes(std::span(header));
    const auto items = std::as_bytes(values);
    file.reserve(head.size() + items.size());
    file.assign(head.begin(), head.end());
    file.insert(file.end(), items.begin(), items.end());
    return Status();
  });
  if (!status.ok()) return with_path(path, std::move(status));
  return write_file(path, file);
}

}  // namespace flagstone::io

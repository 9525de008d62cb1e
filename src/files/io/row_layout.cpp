// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/row_layout.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

bool is_field_name(std::string_view name) {
  return !name.empty() && name.size() <= max_name_length && std::ranges::all_of(name, [](char c) {
    return c > ' ' && c <= '~' && c != '\'' && c != '"' && c != '\\';
  });
}

Status check_names(std::span<const Field> fields) {
  std::vector<std::string_view> names;
  names.reserve(fields.size());
  for (const Field& field : fields) {
    if (!is_field_name(field.name)) {
      return invalid(
          "field name {}: allowed are 1 to {} printable ASCII characters without space, quotes and "
          "backslash",
          quote(field.name), max_name_length);
    }
    if (!field.is_padding()) names.push_back(field.name);
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice == names.end()) return {};
  return invalid("field {} occurs twice (rename one; only {} may repeat)", quote(*twice),
                 quote(padding_name));
}

Status check_coordinates(std::span<const Field> fields) {
  for (const std::string_view name : {"x", "y", "z"}) {
    const auto field = std::ranges::find(fields, name, &Field::name);
    if (field == fields.end()) {
      std::string present;
      for (const Field& other : fields.first(std::min<std::size_t>(fields.size(), 8))) {
        if (!present.empty()) present += ' ';
        present += quote(other.name);
      }
      return invalid("no field {} (a point needs x, y and z; there are: {}{})", quote(name),
                     present, fields.size() > 8 ? " ..." : "");
    }
    if (field->count != 1) {
      return invalid("field {} has count {} (x, y and z must be one number each)", quote(name),
                     field->count);
    }
  }
  return {};
}

template <std::size_t Size>
void copy_items(const std::byte* from, std::size_t from_stride, std::byte* to,
                std::size_t to_stride, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * to_stride, from + i * from_stride, Size);
  }
}

}  // namespace

Status lay_out(std::span<Field> fields, std::size_t& stride) {
  if (fields.size() > max_fields) {
    return invalid("{} fields (at most {} are allowed)", fields.size(), max_fields);
  }
  if (Status status = check_names(fields); !status.ok()) return status;
  if (Status status = check_coordinates(fields); !status.ok()) return status;
  std::size_t offset = 0;
  for (Field& field : fields) {
    const std::size_t item = size_of(field.type);
    if (field.count == 0 || field.count > (max_stride - offset) / item) {
      return invalid("field {} has count {} (allowed: 1 or more, rows of at most {} bytes)",
                     quote(field.name), field.count, max_stride);
    }
    field.offset = offset;
    offset += field.count * item;
  }
  stride = offset;
  return {};
}

std::size_t numbers_in_row(std::span<const Field> fields) noexcept {
  std::size_t numbers = 0;
  for (const Field& field : fields) numbers += field.count;
  return numbers;
}

void copy_column(const std::byte* from, std::size_t from_stride, std::byte* to,
                 std::size_t to_stride, std::size_t size, std::size_t count) noexcept {
  switch (size) {
    case 1: return copy_items<1>(from, from_stride, to, to_stride, count);
    case 2: return copy_items<2>(from, from_stride, to, to_stride, count);
    case 4: return copy_items<4>(from, from_stride, to, to_stride, count);
    case 8: return copy_items<8>(from, from_stride, to, to_stride, count);
    default: break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(to + i * to_stride, from + i * from_stride, size);
  }
}

std::vector<std::byte> rows_from_columns(std::span<const std::byte> columns,
                                         std::span<const Field> fields, std::size_t stride) {
  if (columns.empty()) return {};
  std::vector<std::byte> rows(columns.size());
  const std::size_t count = columns.size() / stride;
  for (const Field& field : fields) {
    const std::byte* column = columns.data() + field.offset * count;
    copy_column(column, field.size(), rows.data() + field.offset, stride, field.size(), count);
  }
  return rows;
}

void swap_bytes(std::span<std::byte> rows, std::size_t stride, const Field& field) noexcept {
  const std::size_t item = size_of(field.type);
  if (item == 1) return;
  for (std::size_t row = 0; row < rows.size(); row += stride) {
    for (std::size_t i = 0; i < field.count; ++i) {
      const auto number = rows.subspan(row + field.offset + i * item, item);
      std::ranges::reverse(number);
    }
  }
}

}  // namespace flagstone::io

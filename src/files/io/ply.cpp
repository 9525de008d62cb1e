// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "files/io/ascii_rows.hpp"
#include "files/io/binary_rows.hpp"
#include "files/io/field_type.hpp"
#include "files/io/message.hpp"
#include "files/io/ply_header.hpp"
#include "files/io/row_layout.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

constexpr std::string_view vertex_name = "vertex";

Status fields_of(const PlyElement& vertex, std::vector<Field>& out, std::size_t& stride) {
  for (const PlyProperty& property : vertex.properties) {
    if (property.length_type) {
      return bad_byte(property.offset,
                      "property {} of element vertex is a list (only numbers are read there; write "
                      "the file without it)",
                      quote(property.name));
    }
    out.push_back({std::string(property.name.substr(0, max_name_length + 1)), property.type});
  }
  if (const Status status = lay_out(out, stride); !status.ok()) {
    return bad_byte(vertex.offset, "element vertex: {}", status.message());
  }
  return {};
}

/// Finds the end of elements in a binary file.
class ElementSkipper {
 public:
  ElementSkipper(std::span<const std::byte> bytes, std::size_t offset, bool big_endian)
      : bytes_(bytes), offset_(offset), big_endian_(big_endian) {}

  [[nodiscard]] std::size_t offset() const { return offset_; }

  Status skip(const PlyElement& element) {
    if (std::ranges::none_of(element.properties, is_list)) return skip_rows(element);
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (Status status = skip(element, property); !status.ok()) return status;
      }
    }
    return {};
  }

 private:
  static bool is_list(const PlyProperty& property) { return property.length_type.has_value(); }

  [[nodiscard]] Status cut_off(const PlyElement& element) const {
    return bad_byte(bytes_.size(), "the file ends within the {} of element {} before the points",
                    element.count, quote(element.name));
  }

  Status skip_rows(const PlyElement& element) {
    std::size_t row = 0;
    for (const PlyProperty& property : element.properties) row += size_of(property.type);
    if (row == 0) return {};
    if (element.count > (bytes_.size() - offset_) / row) return cut_off(element);
    offset_ += element.count * row;
    return {};
  }

  Status skip(const PlyElement& element, const PlyProperty& property) {
    std::size_t numbers = 1;
    if (property.length_type) {
      const std::size_t size = size_of(*property.length_type);
      if (bytes_.size() - offset_ < size) return cut_off(element);
      const std::int64_t length = length_at(offset_, *property.length_type);
      if (length < 0) {
        return bad_byte(offset_, "a list {} of length {} in element {}", quote(property.name),
                        length, quote(element.name));
      }
      numbers = static_cast<std::size_t>(length);
      offset_ += size;
    }
    const std::size_t item = size_of(property.type);
    if (numbers > (bytes_.size() - offset_) / item) return cut_off(element);
    offset_ += numbers * item;
    return {};
  }

  /// PLY's integers have 32 bits at most.
  [[nodiscard]] std::int64_t length_at(std::size_t offset, FieldType type) const {
    return visit_type(type, [&]<class T>() {
      std::array<std::byte, sizeof(T)> number;
      const auto from = bytes_.subspan(offset, sizeof(T));
      if (big_endian_) {
        std::ranges::reverse_copy(from, number.begin());
      } else {
        std::ranges::copy(from, number.begin());
      }
      return static_cast<std::int64_t>(load<T>(number.data()));
    });
  }

  std::span<const std::byte> bytes_;
  std::size_t offset_;
  bool big_endian_;
};

Status read_binary_vertices(std::span<const std::byte> bytes, const PlyHeader& header,
                            std::size_t vertex_index, std::span<const Field> fields,
                            std::size_t stride, std::vector<std::byte>& rows) {
  const bool big_endian = header.data == PlyData::binary_big_endian;
  ElementSkipper skipper(bytes, header.size, big_endian);
  for (std::size_t i = 0; i < vertex_index; ++i) {
    if (Status status = skipper.skip(header.elements[i]); !status.ok()) return status;
  }
  const std::size_t points = header.elements[vertex_index].count;
  const bool is_last = vertex_index + 1 == header.elements.size();
  Status status = check_binary_rows(bytes, skipper.offset(), points, stride, is_last);
  if (!status.ok()) return status;
  const auto data = bytes.subspan(skipper.offset(), points * stride);
  rows.assign(data.begin(), data.end());
  if (big_endian) {
    for (const Field& field : fields) swap_bytes(rows, stride, field);
  }
  return {};
}

Status read_ascii_vertices(std::string_view text, const PlyHeader& header, std::size_t vertex_index,
                           std::span<const Field> fields, std::size_t stride,
                           std::vector<std::byte>& rows) {
  std::size_t offset = header.size;
  for (std::size_t i = 0; i < vertex_index; ++i) {
    const PlyElement& element = header.elements[i];
    if (element.properties.empty()) continue;
    if (Status status = skip_lines(text, element.count, offset); !status.ok()) return status;
  }
  const std::size_t points = header.elements[vertex_index].count;
  Status status = read_ascii_rows(text, fields, stride, points, offset, rows);
  if (!status.ok() || vertex_index + 1 < header.elements.size()) return status;
  return check_nothing_follows(text, offset, points);
}

const char* ply_type(FieldType type) {
  switch (type) {
    case FieldType::int8: return "char";
    case FieldType::uint8: return "uchar";
    case FieldType::int16: return "short";
    case FieldType::uint16: return "ushort";
    case FieldType::int32: return "int";
    case FieldType::uint32: return "uint";
    case FieldType::float32: return "float";
    case FieldType::int64:
    case FieldType::uint64:
    case FieldType::float64: return "double";
  }
  return "double";
}

/// One number of a point on its way from a row of the cloud to a row of the file.
struct Column {
  const Field* from = nullptr;
  std::size_t element = 0;
  Field to;
};

Status plan_columns(const Cloud& cloud, std::vector<Column>& columns, std::size_t& stride) {
  std::vector<Field> properties;
  for (const Field& field : cloud.fields()) {
    if (field.is_padding()) continue;
    const bool is_wide = is_integer(field.type) && size_of(field.type) == 8;
    const FieldType type = is_wide ? FieldType::float64 : field.type;
    for (std::size_t i = 0; i < field.count; ++i) {
      if (properties.size() == max_fields) {
        return invalid("more than {} properties for PLY (write PCD or NPY)", max_fields);
      }
      properties.push_back(
          {field.count == 1 ? field.name : fmt::format("{}_{}", field.name, i), type});
      columns.push_back({&field, i, {}});
    }
  }
  if (const Status status = lay_out(properties, stride); !status.ok()) {
    return invalid("{} (as PLY properties; write PCD or NPY)", status.message());
  }
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i].to = std::move(properties[i]);
  return {};
}

/// Whether a double holds every integer up to this magnitude.
template <class T>
bool is_exact_as_double(T value) {
  constexpr T limit = T{1} << 53U;
  if constexpr (std::is_signed_v<T>) {
    if (value < -limit) return false;
  }
  return value <= limit;
}

template <class T>
Status convert_to_double(const Cloud& cloud, const Column& column, std::size_t stride,
                         std::span<std::byte> rows) {
  const std::byte* const from =
      cloud.bytes().data() + column.from->offset + column.element * sizeof(T);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const T value = load<T>(from + i * cloud.stride());
    if (!is_exact_as_double(value)) {
      return invalid(
          "field {} of point {} is {}: PLY has no 64-bit integers and double would round it (write "
          "PCD or NPY)",
          quote(column.from->name), i, value);
    }
    store(rows.data() + i * stride + column.to.offset, static_cast<double>(value));
  }
  return {};
}

Status fill_column(const Cloud& cloud, const Column& column, std::size_t stride,
                   std::span<std::byte> rows) {
  if (column.from->type == FieldType::int64) {
    return convert_to_double<std::int64_t>(cloud, column, stride, rows);
  }
  if (column.from->type == FieldType::uint64) {
    return convert_to_double<std::uint64_t>(cloud, column, stride, rows);
  }
  const std::size_t item = size_of(column.to.type);
  copy_column(cloud.bytes().data() + column.from->offset + column.element * item, cloud.stride(),
              rows.data() + column.to.offset, stride, item, cloud.size());
  return {};
}

std::string header_of(const Cloud& cloud, std::span<const Column> columns) {
  std::string header =
      fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", cloud.size());
  for (const Column& column : columns) {
    header += fmt::format("property {} {}\n", ply_type(column.to.type), column.to.name);
  }
  return header + "end_header\n";
}

}  // namespace

Status read_ply(std::span<const std::byte> bytes, Cloud& out) {
  return within_memory([&] {
    const std::string_view text = as_text(bytes);
    PlyHeader header;
    if (Status status = read_ply_header(text, header); !status.ok()) return status;
    const auto vertex = std::ranges::find(header.elements, vertex_name, &PlyElement::name);
    if (vertex == header.elements.end()) {
      return bad_byte(0, "the PLY header has no element 'vertex'");
    }
    std::vector<Field> fields;
    std::size_t stride = 0;
    if (Status status = fields_of(*vertex, fields, stride); !status.ok()) return status;
    const auto index = static_cast<std::size_t>(vertex - header.elements.begin());
    std::vector<std::byte> rows;
    Status status = header.data == PlyData::ascii
                        ? read_ascii_vertices(text, header, index, fields, stride, rows)
                        : read_binary_vertices(bytes, header, index, fields, stride, rows);
    if (!status.ok()) return status;
    return Cloud::from_rows(std::move(fields), std::move(rows), out);
  });
}

Status write_ply(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    std::vector<Column> columns;
    std::size_t stride = 0;
    if (Status status = plan_columns(cloud, columns, stride); !status.ok()) return status;
    const std::string header = header_of(cloud, columns);
    const auto head = std::as_bytes(std::span(header));
    std::vector<std::byte> file;
    file.reserve(head.size() + cloud.size() * stride);
    file.assign(head.begin(), head.end());
    file.resize(head.size() + cloud.size() * stride);
    const std::span rows = std::span(file).subspan(head.size());
    for (const Column& column : columns) {
      if (cloud.empty()) break;
      if (Status status = fill_column(cloud, column, stride, rows); !status.ok()) return status;
    }
    out = std::move(file);
    return Status();
  });
}

}  // namespace flagstone::io

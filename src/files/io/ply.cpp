// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/rows.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

/// How the numbers of a PLY file are stored.
enum class PlyData { ascii, binary_little_endian, binary_big_endian };

/// A property of an element: a number, or a list of numbers preceded by its length.
struct PlyProperty {
  std::string_view name;  ///< refers to the text of the header
  FieldType type = FieldType::float32;
  std::optional<FieldType> length_type;  ///< of a list
  std::size_t offset = 0;                ///< of its line in the file
};

/// A type of element; the file contains `count` of them.
struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t offset = 0;  ///< of its line in the file
};

/// The contents of a PLY header, not yet checked against the size of the file.
struct PlyHeader {
  PlyData data = PlyData::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes of the header; the first element follows
};

std::optional<FieldType> type_named(std::string_view name) {
  using enum FieldType;
  static constexpr std::array<std::pair<std::string_view, FieldType>, 16> names{
      {{"char", int8},
       {"uchar", uint8},
       {"short", int16},
       {"ushort", uint16},
       {"int", int32},
       {"uint", uint32},
       {"float", float32},
       {"double", float64},
       {"int8", int8},
       {"uint8", uint8},
       {"int16", int16},
       {"uint16", uint16},
       {"int32", int32},
       {"uint32", uint32},
       {"float32", float32},
       {"float64", float64}}};
  const auto* const found =
      std::ranges::find(names, name, &std::pair<std::string_view, FieldType>::first);
  if (found == names.end()) return std::nullopt;
  return found->second;
}

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view text, PlyHeader& out) : text_(text), out_(out) {}

  Status read() {
    std::size_t offset = 0;
    if (words_of(next_line(text_, offset), 2) != std::vector<std::string_view>{"ply"}) {
      return bad_byte(0, "not a PLY file (expected 'ply' on the first line)");
    }
    while (true) {
      if (offset == text_.size()) {
        return bad_byte(offset, "the file ends within the PLY header (expected end_header)");
      }
      const std::size_t begin = offset;
      const auto words = words_of(next_line(text_, offset), longest_line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (Status status = read_line(begin, words); !status.ok()) return status;
    }
    out_.size = offset;
    if (!has_format_) return bad_byte(0, "the PLY header has no format line");
    return {};
  }

 private:
  using Words = std::vector<std::string_view>;
  // "property list TYPE TYPE NAME", and one word more to detect lines that are too long.
  static constexpr std::size_t longest_line = 6;

  Status read_line(std::size_t begin, const Words& words) {
    if (words[0] == "format") return read_format(begin, words);
    if (words[0] == "element") return read_element(begin, words);
    if (words[0] == "property") return read_property(begin, words);
    return bad_byte(begin,
                    "{} is not a PLY header line (expected format, element, property, comment, "
                    "obj_info or end_header)",
                    quote(words[0]));
  }

  Status read_format(std::size_t begin, const Words& words) {
    constexpr std::array<std::string_view, 3> formats{"ascii", "binary_little_endian",
                                                      "binary_big_endian"};
    const auto* const found =
        words.size() == 3 ? std::ranges::find(formats, words[1]) : formats.end();
    if (has_format_ || found == formats.end() || words[2] != "1.0") {
      return bad_byte(begin,
                      "the format line is wrong or repeated (expected one line 'format ascii 1.0', "
                      "or binary_little_endian or binary_big_endian instead of ascii)");
    }
    out_.data = static_cast<PlyData>(found - formats.begin());
    has_format_ = true;
    return {};
  }

  Status read_element(std::size_t begin, const Words& words) {
    const auto count = words.size() == 3 ? whole_number<std::size_t>(words[2]) : std::nullopt;
    if (!count) {
      return bad_byte(begin,
                      "the element line is wrong (expected 'element NAME COUNT', COUNT an integer "
                      "of at least 0)");
    }
    if (std::ranges::find(out_.elements, words[1], &PlyElement::name) != out_.elements.end()) {
      return bad_byte(begin, "element {} occurs twice", quote(words[1]));
    }
    if (out_.elements.size() == most_elements) {
      return bad_byte(begin, "the file has more than {} elements", most_elements);
    }
    out_.elements.push_back({words[1], *count, {}, begin});
    return {};
  }

  Status read_property(std::size_t begin, const Words& words) {
    if (out_.elements.empty()) return bad_byte(begin, "a property precedes the first element");
    std::vector<PlyProperty>& properties = out_.elements.back().properties;
    if (properties.size() == max_fields) {
      return bad_byte(begin, "the element has more than {} properties", max_fields);
    }
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) {
      return bad_byte(begin,
                      "the property line is wrong (expected 'property TYPE NAME' or 'property list "
                      "TYPE TYPE NAME')");
    }
    const auto type = type_named(words[words.size() - 2]);
    const auto length_type = is_list ? type_named(words[2]) : std::nullopt;
    if (!type || (is_list && !(length_type && is_integer(*length_type)))) {
      return bad_byte(begin,
                      "{} is not a property type (expected char, uchar, short, ushort, int, uint, "
                      "float or double; an integer type for list lengths)",
                      quote(type ? words[2] : words[words.size() - 2]));
    }
    properties.push_back({words.back(), *type, length_type, begin});
    return {};
  }

  static constexpr std::size_t most_elements = 64;  // each name is compared with all others

  std::string_view text_;
  PlyHeader& out_;
  bool has_format_ = false;
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_ply_header(std::string_view text, PlyHeader& out) {
  return PlyHeaderReader(text, out).read();
}

constexpr std::string_view vertex_name = "vertex";

Status fields_of(const PlyElement& vertex, std::vector<Field>& out, std::size_t& stride) {
  for (const PlyProperty& property : vertex.properties) {
    if (property.length_type) {
      return bad_byte(
          property.offset,
          "property {} of element 'vertex' is a list (expected a number; write the file "
          "without this list)",
          quote(property.name));
    }
    out.push_back({std::string(property.name.substr(0, max_name_length + 1)), property.type});
  }
  if (const Status status = lay_out(out, stride); !status.ok()) {
    return bad_byte(vertex.offset, "element 'vertex': {}", status.message());
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
    return bad_byte(bytes_.size(),
                    "the file ends within the {} items of element {}, before the points (the file "
                    "may be truncated)",
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
        return bad_byte(offset_, "list {} of element {} has length {} (expected 0 or more)",
                        quote(property.name), quote(element.name), length);
      }
      numbers = static_cast<std::size_t>(length);
      offset_ += size;
    }
    const std::size_t item = size_of(property.type);
    if (numbers > (bytes_.size() - offset_) / item) return cut_off(element);
    offset_ += numbers * item;
    return {};
  }

  /// Integers in PLY files have at most 32 bits.
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

/// Source (in a row of the cloud) and destination (in a row of the file) of one number per point.
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
        return invalid("the file would have more than {} properties (write PCD or NPY instead)",
                       max_fields);
      }
      properties.push_back(
          {field.count == 1 ? field.name : fmt::format("{}_{}", field.name, i), type});
      columns.push_back({&field, i, {}});
    }
  }
  if (const Status status = lay_out(properties, stride); !status.ok()) {
    return invalid("PLY properties: {}; or write PCD or NPY instead", status.message());
  }
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i].to = std::move(properties[i]);
  return {};
}

/// Whether a double represents every integer up to this magnitude exactly.
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
          "field {} of point {} is {}, which PLY cannot store exactly (it has no 64-bit integers; "
          "write PCD or NPY instead)",
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

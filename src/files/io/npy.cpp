// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/npy.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "files/io/rows.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t most_dimensions = 32;  // NumPy's own limit

struct TypeCode {
  std::string_view code;
  FieldType type;
};
constexpr std::array<TypeCode, 11> type_codes{{{"i1", FieldType::int8},
                                               {"u1", FieldType::uint8},
                                               {"i2", FieldType::int16},
                                               {"u2", FieldType::uint16},
                                               {"i4", FieldType::int32},
                                               {"u4", FieldType::uint32},
                                               {"i8", FieldType::int64},
                                               {"u8", FieldType::uint64},
                                               {"f4", FieldType::float32},
                                               {"f8", FieldType::float64},
                                               {"b1", FieldType::uint8}}};

std::string_view code_of(FieldType type) {
  return std::ranges::find(type_codes, type, &TypeCode::type)->code;
}

/// Parses the Python dictionary in a NumPy header. Only the literals that NumPy writes are
/// accepted.
class DictReader {
 public:
  /// The dictionary lies between `begin` and `end`.
  DictReader(std::string_view text, std::size_t begin, std::size_t end)
      : text_(text.substr(0, end)), at_(begin) {}

  Status read(NpyHeader& out) {
    if (!take('{')) return unexpected("a dictionary that begins with {");
    bool has_descr = false;
    bool has_order = false;
    bool has_shape = false;
    while (!take('}')) {
      std::string_view key;
      if (!take_string(key) || !take(':')) return unexpected("a quoted key and a colon");
      bool* const seen = key == "descr"           ? &has_descr
                         : key == "fortran_order" ? &has_order
                         : key == "shape"         ? &has_shape
                                                  : nullptr;
      if (seen == nullptr || std::exchange(*seen, true)) {
        return unexpected("the keys 'descr', 'fortran_order' and 'shape' once each");
      }
      Status status = key == "descr"           ? read_descr(out)
                      : key == "fortran_order" ? read_order(out.fortran_order)
                                               : read_shape(out);
      if (!status.ok()) return status;
      if (!take(',') && !peek('}')) return unexpected("a comma or }");
    }
    if (has_descr && has_order && has_shape) return {};
    return unexpected("the keys 'descr', 'fortran_order' and 'shape' once each");
  }

 private:
  [[nodiscard]] Status unexpected(std::string_view expected) const {
    return bad_byte(at_, "the NumPy header contains {} (expected {})", quote(text_.substr(at_)),
                    expected);
  }

  void skip_blanks() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '\n')) ++at_;
  }

  bool peek(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
  }

  bool take(char c) {
    if (!peek(c)) return false;
    ++at_;
    return true;
  }

  /// A string without escapes; `out` is the text between the quotes.
  bool take_string(std::string_view& out) {
    if (!peek('\'') && !peek('"')) return false;
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    if (end == std::string_view::npos) return false;
    out = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return true;
  }

  bool take_number(std::size_t& out) {
    skip_blanks();
    const std::string_view rest = text_.substr(at_);
    const auto* const end =
        std::ranges::find_if_not(rest, [](char c) { return c >= '0' && c <= '9'; });
    const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    const auto number = whole_number<std::size_t>(digits);
    if (!number) return false;
    out = *number;
    at_ += digits.size();
    if (at_ < text_.size() && text_[at_] == 'L') ++at_;  // suffix of a Python 2 long
    return true;
  }

  Status read_order(bool& out) {
    skip_blanks();
    for (const auto& [word, value] :
         {std::pair{std::string_view("True"), true}, std::pair{std::string_view("False"), false}}) {
      if (!text_.substr(at_).starts_with(word)) continue;
      at_ += word.size();
      out = value;
      return {};
    }
    return unexpected("True or False");
  }

  /// A tuple of integers.
  Status read_tuple(std::vector<std::size_t>& out) {
    if (!take('(')) return unexpected("a tuple");
    while (!take(')')) {
      std::size_t number = 0;
      if (out.size() == most_dimensions || !take_number(number)) {
        return unexpected("at most 32 integers");
      }
      out.push_back(number);
      if (!take(',') && !peek(')')) return unexpected("a comma or )");
    }
    return {};
  }

  Status read_shape(NpyHeader& out) {
    skip_blanks();
    out.shape_offset = at_;
    return read_tuple(out.shape);
  }

  Status read_descr(NpyHeader& out) {
    skip_blanks();
    out.descr_offset = at_;
    out.is_structured = take('[');
    if (!out.is_structured) {
      out.fields.emplace_back();
      return read_type(out.fields.back(), false);
    }
    while (!take(']')) {
      if (out.fields.size() == max_fields) {
        return bad_byte(at_, "the array has more than {} fields", max_fields);
      }
      out.fields.emplace_back();
      if (Status status = read_record_field(out.fields.back()); !status.ok()) return status;
      if (!take(',') && !peek(']')) return unexpected("a comma or ]");
    }
    return {};
  }

  /// ('name', 'type') or ('name', 'type', shape).
  Status read_record_field(NpyField& out) {
    std::string_view name;
    if (!take('(') || !take_string(name) || !take(',')) {
      return unexpected("a field ('name', 'type')");
    }
    out.field.name = name.substr(0, max_name_length + 1);
    if (Status status = read_type(out, name.empty()); !status.ok()) return status;
    if (take(',') && !peek(')')) {
      if (Status status = read_field_shape(out.field); !status.ok()) return status;
    }
    return take(')') ? Status() : unexpected("a )");
  }

  Status read_field_shape(Field& out) {
    std::vector<std::size_t> shape;
    const std::size_t begin = at_;
    if (peek('(')) {
      if (Status status = read_tuple(shape); !status.ok()) return status;
    } else if (!take_number(shape.emplace_back())) {
      return unexpected("the shape of a field");
    }
    for (const std::size_t length : shape) {
      if (length == 0 || length > max_stride / out.count) {
        return bad_byte(begin,
                        "field {} has no items or too many items (expected at least 1, and rows of "
                        "at most {} bytes)",
                        quote(out.name), max_stride);
      }
      out.count *= length;
    }
    return {};
  }

  /// A type such as '<f4'. A field without a name and with a type such as '|V4' is padding.
  Status read_type(NpyField& out, bool may_be_padding) {
    skip_blanks();
    const std::size_t begin = at_;
    std::string_view text;
    if (!take_string(text)) return unexpected("a type such as '<f4'");
    const bool has_order =
        !text.empty() && std::string_view("<>|=").find(text[0]) != std::string_view::npos;
    out.big_endian = has_order && text[0] == '>';
    const std::string_view code = text.substr(has_order ? 1 : 0);
    if (may_be_padding && code.starts_with('V')) {
      const auto bytes = whole_number<std::size_t>(code.substr(1));
      if (bytes && *bytes > 0 && *bytes <= max_stride) {
        out.field = {std::string(padding_name), FieldType::uint8, *bytes};
        return {};
      }
    }
    const auto* const found = std::ranges::find(type_codes, code, &TypeCode::code);
    if (found == type_codes.end()) {
      return bad_byte(begin,
                      "type {} is not supported (expected i or u with 1, 2, 4 or 8 bytes, f4, f8 "
                      "or b1)",
                      quote(text));
    }
    out.field.type = found->type;
    out.boolean = code == "b1";
    return {};
  }

  std::string_view text_;
  std::size_t at_;
};

/// Magic, version, length and `dictionary`, padded with spaces so that the items begin at a
/// multiple of 64 bytes, as the format requires.
std::string with_preamble(std::string dictionary) {
  constexpr std::size_t alignment = 64;
  const bool is_long = dictionary.size() > UINT16_MAX - 2 * alignment;
  const std::size_t length_size = is_long ? 4 : 2;
  const std::size_t before = magic.size() + 2 + length_size;
  const std::size_t unpadded = before + dictionary.size() + 1;
  dictionary.append((alignment - unpadded % alignment) % alignment, ' ');
  dictionary += '\n';
  std::string header(magic);
  header += is_long ? '\x02' : '\x01';
  header += '\0';
  for (std::size_t i = 0; i < length_size; ++i) {
    header += static_cast<char>((dictionary.size() >> (8 * i)) & 0xffU);
  }
  return header + dictionary;
}

std::string with_preamble(std::string_view descr, std::span<const std::size_t> shape) {
  // A Python tuple of one number ends with a comma.
  return with_preamble(fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({}{}), }}",
                                   descr, fmt::join(shape, ", "), shape.size() == 1 ? "," : ""));
}

}  // namespace

Status read_npy_header(std::string_view text, NpyHeader& out) {
  if (!text.starts_with(magic)) {
    return bad_byte(0, "not a NumPy file (expected \\x93NUMPY at the start)");
  }
  const std::size_t version_at = magic.size();
  const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
  if (text.size() < version_at + 6) {
    return bad_byte(text.size(),
                    "the file ends within the NumPy header (the file may be truncated)");
  }
  const auto major = std::to_integer<unsigned>(bytes[version_at]);
  if (major < 1 || major > 3) {
    return bad_byte(version_at, "NumPy format {} is not supported (expected 1, 2 or 3)", major);
  }
  const std::size_t length_at = version_at + 2;
  const std::size_t begin = length_at + (major == 1 ? 2 : 4);
  const std::size_t length =
      major == 1 ? load<std::uint16_t>(bytes + length_at) : load<std::uint32_t>(bytes + length_at);
  if (length > text.size() - begin) {
    return bad_byte(text.size(),
                    "the file ends after {} bytes of the NumPy header (expected {}; the file may "
                    "be truncated)",
                    text.size() - begin, length);
  }
  out.size = begin + length;
  return DictReader(text, begin, out.size).read(out);
}

std::string npy_header(std::span<const Field> fields, std::span<const std::size_t> shape) {
  std::string descr = "[";
  for (const Field& field : fields) {
    if (field.is_padding()) {
      descr += fmt::format("('', '|V{}'), ", field.size());
      continue;
    }
    const char order = size_of(field.type) == 1 ? '|' : '<';
    descr += fmt::format("('{}', '{}{}'", field.name, order, code_of(field.type));
    descr += field.count == 1 ? "), " : fmt::format(", ({},)), ", field.count);
  }
  return with_preamble(descr + "]", shape);
}

std::string npy_header(std::span<const Field> fields, std::size_t count) {
  return npy_header(fields, std::array{count});
}

std::string npy_header(FieldType type, std::span<const std::size_t> shape) {
  const char order = size_of(type) == 1 ? '|' : '<';
  return with_preamble(fmt::format("'{}{}'", order, code_of(type)), shape);
}

std::string npy_header(FieldType type, std::size_t count) {
  return npy_header(type, std::array{count});
}

namespace {

/// The array as a table with one point per row.
struct Table {
  std::vector<Field> fields;
  std::size_t stride = 0;
  std::size_t points = 0;
  bool by_columns = false;
};

Status booleans(std::size_t offset, std::string_view what) {
  return bad_byte(
      offset, "{} contains booleans (expected integers or floats; the file may be a mask)", what);
}

Status table_of(const NpyHeader& header, Table& out) {
  const auto& shape = header.shape;
  if (header.is_structured) {
    if (shape.size() != 1) {
      return bad_byte(header.shape_offset, "the array of records has {} dimensions (expected 1)",
                      shape.size());
    }
    for (const NpyField& field : header.fields) {
      const std::string& name = field.field.name;
      if (field.boolean && (name == "x" || name == "y" || name == "z")) {
        return booleans(header.descr_offset, fmt::format("field {}", quote(name)));
      }
      out.fields.push_back(field.field);
    }
  } else {
    if (shape.size() != 2 || shape[1] < 3 || shape[1] > max_fields) {
      return bad_byte(header.shape_offset,
                      "the array has the wrong shape (expected N x 3 to N x {}: one point per row, "
                      "x, y and z first)",
                      max_fields);
    }
    if (header.fields[0].boolean) return booleans(header.descr_offset, "the array");
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

namespace {

Status parse_heights(std::span<const std::byte> bytes, std::size_t expected_points,
                     std::vector<float>& heights) {
  NpyHeader header;
  if (Status status = read_npy_header(as_text(bytes), header); !status.ok()) return status;
  if (header.is_structured || header.shape.size() != 1) {
    return bad_byte(header.shape_offset,
                    "the array has the wrong shape (expected one dimension: one height per point)");
  }
  const NpyField& item = header.fields[0];
  if (item.field.type != FieldType::float32 || item.big_endian) {
    return bad_byte(header.descr_offset,
                    "the heights have the wrong type (expected little-endian float32, '<f4')");
  }
  const std::size_t count = header.shape[0];
  if (count != expected_points) {
    return bad_byte(header.shape_offset,
                    "the file contains {} heights, but the scan has {} points (expected one height "
                    "per point; check whether the file belongs to this scan)",
                    count, expected_points);
  }
  const std::span<const std::byte> items = bytes.subspan(header.size);
  if (items.size() % sizeof(float) != 0 || items.size() / sizeof(float) != count) {
    return bad_byte(header.shape_offset,
                    "the header specifies {} heights of {} bytes, but {} bytes follow", count,
                    sizeof(float), items.size());
  }
  std::vector<float> read(count);
  if (count > 0) std::memcpy(read.data(), items.data(), items.size());
  heights = std::move(read);
  return {};
}

}  // namespace

std::size_t height_file_size(std::size_t points) {
  return npy_header(FieldType::float32, points).size() + points * sizeof(float);
}

Status read_height_file(const std::filesystem::path& path, std::size_t expected_points,
                        std::vector<float>& heights) {
  std::vector<std::byte> file;
  if (Status status = load_bytes(path, file); !status.ok()) return status;
  return with_path(path,
                   within_memory([&] { return parse_heights(file, expected_points, heights); }));
}

}  // namespace flagstone::io

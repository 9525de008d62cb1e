// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/pcd.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "files/io/lzf.hpp"
#include "files/io/message.hpp"
#include "files/io/rows.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

/// How the points of a PCD file are stored.
enum class PcdData { ascii, binary, binary_compressed };

/// The contents of a PCD header: consistent, but not yet checked against the size of the file.
struct PcdHeader {
  std::vector<Field> fields;
  std::size_t stride = 0;
  std::size_t points = 0;
  PcdData data = PcdData::ascii;
  std::size_t size = 0;  ///< bytes of the header; the points follow
};

enum Key { version, fields, size, type, count, width, height, viewpoint, points, data, key_count };

constexpr std::array<std::string_view, key_count> key_names{
    "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// A header line: its offset and the words after the key. `present` distinguishes a line without
/// values from a missing line.
struct Line {
  bool present = false;
  std::size_t offset = 0;
  std::vector<std::string_view> values;
};

/// Collects the lines of the header, then interprets them.
class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(std::string_view text) : text_(text) {}

  Status read(PcdHeader& out) {
    if (Status status = collect_lines(out.size); !status.ok()) return status;
    if (Status status = check_version(); !status.ok()) return status;
    if (Status status = read_fields(out.fields); !status.ok()) return status;
    if (const Status status = lay_out(out.fields, out.stride); !status.ok()) {
      return bad_byte(lines_[fields].offset, "{}", status.message());
    }
    if (Status status = read_points(out.points); !status.ok()) return status;
    return read_data(out.data);
  }

 private:
  [[nodiscard]] std::size_t offset_of(std::string_view word) const {
    return static_cast<std::size_t>(word.data() - text_.data());
  }

  Status collect_lines(std::size_t& header_size) {
    std::size_t offset = 0;
    while (!lines_[data].present) {
      const std::size_t begin = offset;
      if (begin == text_.size()) {
        return bad_byte(begin, "the file ends within the PCD header (expected a DATA line)");
      }
      const std::string_view line = next_line(text_, offset);
      std::vector<std::string_view> words = words_of(line, max_fields + 2);
      if (words.empty() || words[0].front() == '#') continue;
      const auto* const key = std::ranges::find(key_names, words[0]);
      if (key == key_names.end()) {
        return bad_byte(offset_of(words[0]),
                        "{} is not a PCD header line (expected VERSION, FIELDS, SIZE, TYPE, COUNT, "
                        "WIDTH, HEIGHT, VIEWPOINT, POINTS or DATA)",
                        quote(words[0]));
      }
      Line& entry = lines_[static_cast<std::size_t>(key - key_names.begin())];
      if (entry.present) return bad_byte(begin, "the PCD header has a second {} line", *key);
      words.erase(words.begin());
      entry = {true, begin, std::move(words)};
    }
    header_size = offset;
    return {};
  }

  /// bad_file if the line is missing or does not have this number of values.
  [[nodiscard]] Status expect(Key key, std::size_t values) const {
    const Line& line = lines_[key];
    if (!line.present) {
      return bad_byte(lines_[data].offset, "the PCD header has no {} line", key_names[key]);
    }
    if (line.values.size() != values) {
      return bad_byte(line.offset, "the {} line has {} values (expected {})", key_names[key],
                      line.values.size(), values);
    }
    return {};
  }

  [[nodiscard]] Status check_version() const {
    if (!lines_[version].present) return {};
    if (Status status = expect(version, 1); !status.ok()) return status;
    const std::string_view word = lines_[version].values[0];
    if (word == "0.7" || word == ".7" || word == "0.6" || word == ".6") return {};
    return bad_byte(offset_of(word), "PCD version {} is not supported (expected 0.6 or 0.7)",
                    quote(word));
  }

  Status read_fields(std::vector<Field>& out) const {
    const auto& names = lines_[fields].values;
    if (names.size() > max_fields) {
      return bad_byte(lines_[fields].offset, "the file has more than {} fields", max_fields);
    }
    if (Status status = expect(fields, names.size()); !status.ok()) return status;
    if (Status status = expect(size, names.size()); !status.ok()) return status;
    if (Status status = expect(type, names.size()); !status.ok()) return status;
    if (lines_[count].present) {
      if (Status status = expect(count, names.size()); !status.ok()) return status;
    }
    out.reserve(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      Field field{std::string(names[i].substr(0, max_name_length + 1))};
      if (Status status = read_type(i, field); !status.ok()) return status;
      out.push_back(std::move(field));
    }
    return {};
  }

  Status read_type(std::size_t i, Field& field) const {
    struct Pair {
      std::string_view type, size;
      FieldType is;
    };
    using enum FieldType;
    static constexpr std::array<Pair, 10> pairs{{{"F", "4", float32},
                                                 {"F", "8", float64},
                                                 {"I", "1", int8},
                                                 {"I", "2", int16},
                                                 {"I", "4", int32},
                                                 {"I", "8", int64},
                                                 {"U", "1", uint8},
                                                 {"U", "2", uint16},
                                                 {"U", "4", uint32},
                                                 {"U", "8", uint64}}};
    const std::string_view letter = lines_[type].values[i];
    const std::string_view bytes = lines_[size].values[i];
    const auto* const found = std::ranges::find_if(
        pairs, [&](const Pair& pair) { return pair.type == letter && pair.size == bytes; });
    if (found == pairs.end()) {
      return bad_byte(
          offset_of(letter),
          "field {} has TYPE {} and SIZE {} (expected TYPE F with SIZE 4 or 8, or TYPE I or U with "
          "SIZE 1, 2, 4 or 8)",
          quote(field.name), quote(letter), quote(bytes));
    }
    field.type = found->is;
    if (lines_[count].present) {
      const std::string_view word = lines_[count].values[i];
      const auto number = whole_number<std::size_t>(word);
      if (!number) {
        return bad_byte(offset_of(word), "COUNT {} of field {} is not an integer of at least 1",
                        quote(word), quote(field.name));
      }
      field.count = *number;
    }
    return {};
  }

  /// The single number of a line, or nothing if the line is missing.
  Status read_number(Key key, std::optional<std::size_t>& out) const {
    if (!lines_[key].present) return {};
    if (Status status = expect(key, 1); !status.ok()) return status;
    const std::string_view word = lines_[key].values[0];
    out = whole_number<std::size_t>(word);
    if (out) return {};
    return bad_byte(offset_of(word), "{} {} is not an integer from 0 to {}", key_names[key],
                    quote(word), std::numeric_limits<std::size_t>::max());
  }

  Status read_points(std::size_t& out) const {
    std::optional<std::size_t> columns;
    std::optional<std::size_t> rows;
    std::optional<std::size_t> total;
    if (Status status = read_number(width, columns); !status.ok()) return status;
    if (Status status = read_number(height, rows); !status.ok()) return status;
    if (Status status = read_number(points, total); !status.ok()) return status;
    if (columns.has_value() != rows.has_value() || !(columns || total)) {
      return bad_byte(lines_[data].offset,
                      "the size is missing from the PCD header (expected WIDTH and HEIGHT, POINTS, "
                      "or all three)");
    }
    if (!columns) {
      out = *total;
      return {};
    }
    if (*rows != 0 && *columns > std::numeric_limits<std::size_t>::max() / *rows) {
      return bad_byte(lines_[width].offset,
                      "WIDTH {} times HEIGHT {} is more points than a file can contain", *columns,
                      *rows);
    }
    out = *columns * *rows;
    if (total && *total != out) {
      return bad_byte(lines_[points].offset, "POINTS {} is not WIDTH {} times HEIGHT {}", *total,
                      *columns, *rows);
    }
    return {};
  }

  Status read_data(PcdData& out) const {
    if (Status status = expect(data, 1); !status.ok()) return status;
    const std::string_view word = lines_[data].values[0];
    constexpr std::array<std::string_view, 3> kinds{"ascii", "binary", "binary_compressed"};
    const auto* const kind = std::ranges::find(kinds, word);
    if (kind == kinds.end()) {
      return bad_byte(offset_of(word),
                      "DATA {} is not supported (expected ascii, binary or binary_compressed)",
                      quote(word));
    }
    out = static_cast<PcdData>(kind - kinds.begin());
    return {};
  }

  std::string_view text_;
  std::array<Line, key_count> lines_;
};

/// Reads the header at the start of `text`. bad_file. Throws std::bad_alloc.
Status read_pcd_header(std::string_view text, PcdHeader& out) {
  return PcdHeaderReader(text).read(out);
}

Status read_ascii(std::span<const std::byte> bytes, const PcdHeader& header,
                  std::vector<std::byte>& rows) {
  const std::string_view text = as_text(bytes);
  std::size_t offset = header.size;
  Status status = read_ascii_rows(text, header.fields, header.stride, header.points, offset, rows);
  if (!status.ok()) return status;
  return check_nothing_follows(text, offset, header.points);
}

Status read_binary(std::span<const std::byte> bytes, const PcdHeader& header,
                   std::vector<std::byte>& rows) {
  Status status = check_binary_rows(bytes, header.size, header.points, header.stride, true);
  if (!status.ok()) return status;
  const auto data = bytes.subspan(header.size, header.points * header.stride);
  rows.assign(data.begin(), data.end());
  return status;
}

/// Two uint32, the compressed and the expanded size, then an LZF stream that contains the first
/// field of all points, then the second field of all points, and so on.
Status read_compressed(std::span<const std::byte> bytes, const PcdHeader& header,
                       std::vector<std::byte>& rows) {
  constexpr std::size_t sizes = 2 * sizeof(std::uint32_t);
  if (bytes.size() - header.size < sizes) {
    return bad_byte(bytes.size(),
                    "the file ends before the two sizes of the compressed data (the file may be "
                    "truncated)");
  }
  const auto data = bytes.subspan(header.size);
  const std::size_t compressed = load<std::uint32_t>(data.data());
  const std::size_t expanded = load<std::uint32_t>(data.data() + sizeof(std::uint32_t));
  if (expanded / header.stride != header.points || expanded % header.stride != 0) {
    return bad_byte(
        header.size + sizeof(std::uint32_t),
        "the compressed data has an expanded size of {} bytes (expected {} points of {} "
        "bytes each)",
        expanded, header.points, header.stride);
  }
  if (compressed > data.size() - sizes) {
    return bad_byte(
        bytes.size(),
        "the file ends after {} bytes of compressed data (expected {}; the file may be truncated)",
        data.size() - sizes, compressed);
  }
  const auto stream = data.subspan(sizes, compressed);
  std::size_t measured = 0;
  if (Status status = measure_lzf(stream, header.size + sizes, measured); !status.ok()) {
    return status;
  }
  if (measured != expanded) {
    return bad_byte(header.size + sizes, "the compressed data expands to {} bytes (expected {})",
                    measured, expanded);
  }
  std::vector<std::byte> columns(expanded);
  expand_lzf(stream, columns);
  rows = rows_from_columns(columns, header.fields, header.stride);
  return {};
}

Status read_rows(std::span<const std::byte> bytes, const PcdHeader& header,
                 std::vector<std::byte>& rows) {
  switch (header.data) {
    case PcdData::ascii: return read_ascii(bytes, header, rows);
    case PcdData::binary: return read_binary(bytes, header, rows);
    case PcdData::binary_compressed: return read_compressed(bytes, header, rows);
  }
  return {};
}

char type_letter(FieldType type) {
  switch (type) {
    case FieldType::float32:
    case FieldType::float64: return 'F';
    case FieldType::uint8:
    case FieldType::uint16:
    case FieldType::uint32:
    case FieldType::uint64: return 'U';
    default: return 'I';
  }
}

std::string header_of(const Cloud& cloud) {
  std::string names = "FIELDS";
  std::string sizes = "SIZE";
  std::string types = "TYPE";
  std::string counts = "COUNT";
  for (const Field& field : cloud.fields()) {
    names += fmt::format(" {}", field.name);
    sizes += fmt::format(" {}", size_of(field.type));
    types += fmt::format(" {}", type_letter(field.type));
    counts += fmt::format(" {}", field.count);
  }
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n{}\n{}\n{}\n{}\nWIDTH {}\nHEIGHT "
      "1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      names, sizes, types, counts, cloud.size(), cloud.size());
}

}  // namespace

Status read_pcd(std::span<const std::byte> bytes, Cloud& out) {
  return within_memory([&] {
    PcdHeader header;
    if (Status status = read_pcd_header(as_text(bytes), header); !status.ok()) return status;
    std::vector<std::byte> rows;
    if (Status status = read_rows(bytes, header, rows); !status.ok()) return status;
    return Cloud::from_rows(std::move(header.fields), std::move(rows), out);
  });
}

Status write_pcd(const Cloud& cloud, std::vector<std::byte>& out) {
  return within_memory([&] {
    const std::string header = header_of(cloud);
    const auto head = std::as_bytes(std::span(header));
    std::vector<std::byte> file;
    file.reserve(head.size() + cloud.bytes().size());
    file.assign(head.begin(), head.end());
    file.insert(file.end(), cloud.bytes().begin(), cloud.bytes().end());
    out = std::move(file);
    return Status();
  });
}

}  // namespace flagstone::io

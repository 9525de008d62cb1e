// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "files/io/message.hpp"
#include "files/io/text.hpp"

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
          "field name {} is not valid (expected 1 to {} printable ASCII characters without spaces, "
          "quotes and backslashes)",
          quote(field.name), max_name_length);
    }
    if (!field.is_padding()) names.push_back(field.name);
  }
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice == names.end()) return {};
  return invalid("field {} occurs twice (rename one of them; only {} may be repeated)",
                 quote(*twice), quote(padding_name));
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
      return invalid("no field {} (expected x, y and z; the fields are: {}{})", quote(name),
                     present, fields.size() > 8 ? " ..." : "");
    }
    if (field->count != 1) {
      return invalid("field {} has count {} (expected one number each for x, y and z)", quote(name),
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
    return invalid("there are {} fields (expected at most {})", fields.size(), max_fields);
  }
  if (Status status = check_names(fields); !status.ok()) return status;
  if (Status status = check_coordinates(fields); !status.ok()) return status;
  std::size_t offset = 0;
  for (Field& field : fields) {
    const std::size_t item = size_of(field.type);
    if (field.count == 0 || field.count > (max_stride - offset) / item) {
      return invalid("field {} has count {} (expected at least 1, and rows of at most {} bytes)",
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

Status check_binary_rows(std::span<const std::byte> bytes, std::size_t offset, std::size_t points,
                         std::size_t stride, bool points_are_last) {
  const std::size_t left = bytes.size() - offset;
  if (points > left / stride) {
    return bad_byte(
        bytes.size(),
        "the header specifies {} points of {} bytes, but the remaining {} bytes contain only {} "
        "(the file may be truncated)",
        points, stride, left, left / stride);
  }
  if (points_are_last && left / stride > points) {
    return bad_byte(
        offset + points * stride,
        "there are {} bytes after the {} points that the header specifies (correct the number of "
        "points in the header)",
        left - points * stride, points);
  }
  return {};
}

namespace {

bool ends_word(char c) { return is_blank(c) || c == '\n'; }

/// Reads a number that fills `word`. False if the word is not a number or out of range for the
/// type.
template <class T>
bool read_number(std::string_view word, std::byte* to) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  T value = 0;
  auto [stop, error] = std::from_chars(begin, end, value);
  if constexpr (std::is_same_v<T, float>) {
    if (error == std::errc::result_out_of_range) {  // accept values too small for a float
      double wide = 0;
      error = std::from_chars(begin, end, wide).ec;
      if (std::abs(wide) > std::numeric_limits<float>::max()) return false;
      value = static_cast<float>(wide);
    }
  }
  if (error != std::errc() || stop != end) return false;
  store(to, value);
  return true;
}

class RowReader {
 public:
  RowReader(std::string_view text, std::size_t offset, std::span<const Field> fields)
      : text_(text), offset_(offset), fields_(fields) {}

  [[nodiscard]] std::size_t offset() const { return offset_; }

  Status read(std::size_t point, std::byte* row) {
    skip([](char c) { return ends_word(c); });
    std::size_t numbers = 0;
    for (const Field& field : fields_) {
      for (std::size_t i = 0; i < field.count; ++i, ++numbers) {
        const std::string_view word = next_word();
        if (word.empty()) {
          return bad_byte(offset_, "point {} has {} numbers (expected {})", point, numbers,
                          numbers_in_row(fields_));
        }
        std::byte* const to = row + field.offset + i * size_of(field.type);
        if (!visit_type(field.type, [&]<class T>() { return read_number<T>(word, to); })) {
          return bad_byte(offset_ - word.size(), "field {} of point {} is {} (expected {})",
                          quote(field.name), point, quote(word), to_string(field.type));
        }
      }
    }
    if (const std::string_view word = next_word(); !word.empty()) {
      return bad_byte(offset_ - word.size(),
                      "{} follows the {} numbers of point {} (expected one point per line)",
                      quote(word), numbers, point);
    }
    return {};
  }

 private:
  template <class Predicate>
  void skip(Predicate skipped) {
    while (offset_ < text_.size() && skipped(text_[offset_])) ++offset_;
  }

  /// The next word of this line, empty at its end.
  std::string_view next_word() {
    skip(is_blank);
    const std::size_t begin = offset_;
    skip([](char c) { return !ends_word(c); });
    return text_.substr(begin, offset_ - begin);
  }

  std::string_view text_;
  std::size_t offset_;
  std::span<const Field> fields_;
};

}  // namespace

Status read_ascii_rows(std::string_view text, std::span<const Field> fields, std::size_t stride,
                       std::size_t points, std::size_t& offset, std::vector<std::byte>& rows) {
  const std::size_t numbers = numbers_in_row(fields);
  const std::size_t left = text.size() - offset;
  if (points > (left + 1) / (2 * numbers)) {
    return bad_byte(
        text.size(),
        "the header specifies {} points of {} numbers, too many for the remaining {} bytes (the "
        "file may be truncated)",
        points, numbers, left);
  }
  rows.resize(points * stride);
  RowReader reader(text, offset, fields);
  for (std::size_t point = 0; point < points; ++point) {
    if (Status status = reader.read(point, rows.data() + point * stride); !status.ok()) {
      return status;
    }
  }
  offset = reader.offset();
  return {};
}

Status skip_lines(std::string_view text, std::size_t lines, std::size_t& offset) {
  for (std::size_t skipped = 0; skipped < lines;) {
    if (offset == text.size()) {
      return bad_byte(offset,
                      "the file ends after {} of the {} lines before the points (the file may be "
                      "truncated)",
                      skipped, lines);
    }
    const std::string_view line = next_line(text, offset);
    if (!std::ranges::all_of(line, is_blank)) ++skipped;
  }
  return {};
}

Status check_nothing_follows(std::string_view text, std::size_t offset, std::size_t points) {
  const auto rest = text.substr(offset);
  const auto found = std::ranges::find_if_not(rest, ends_word);
  if (found == rest.end()) return {};
  return bad_byte(offset + static_cast<std::size_t>(found - rest.begin()),
                  "there is more data after the {} points that the header specifies (correct the "
                  "number of points in the header)",
                  points);
}

}  // namespace flagstone::io

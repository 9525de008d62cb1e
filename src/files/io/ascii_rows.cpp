// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/ascii_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

#include "files/io/field_type.hpp"
#include "files/io/message.hpp"
#include "files/io/row_layout.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

bool ends_word(char c) { return is_blank(c) || c == '\n'; }

/// Reads a number that fills `word`; false where the word is none or the type cannot hold it.
template <class T>
bool read_number(std::string_view word, std::byte* to) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  T value = 0;
  auto [stop, error] = std::from_chars(begin, end, value);
  if constexpr (std::is_same_v<T, float>) {
    if (error ==
        std::errc::result_out_of_range) {  // too small is as good as zero, too large is not
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

/// Reads one point after the other off the text.
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
          return bad_byte(offset_, "point {} has {} numbers, the header announces {} a point",
                          point, numbers, numbers_in_row(fields_));
        }
        std::byte* const to = row + field.offset + i * size_of(field.type);
        if (!visit_type(field.type, [&]<class T>() { return read_number<T>(word, to); })) {
          return bad_byte(offset_ - word.size(), "{} is not a {} (field {} of point {})",
                          quote(word), to_string(field.type), quote(field.name), point);
        }
      }
    }
    if (const std::string_view word = next_word(); !word.empty()) {
      return bad_byte(offset_ - word.size(),
                      "{} after the {} numbers of point {} (one point a line)", quote(word),
                      numbers, point);
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
        "the header announces {} points of {} numbers, too many for the {} bytes behind it "
        "(is the file cut off?)",
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
      return bad_byte(offset, "the file ends after {} of {} lines before the points", skipped,
                      lines);
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
                  "more data after the {} points the header announces (correct the header's count)",
                  points);
}

}  // namespace flagstone::io

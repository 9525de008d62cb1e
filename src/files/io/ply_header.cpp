// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/ply_header.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/text.hpp"

namespace flagstone::io {
namespace {

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

/// Reads the header line by line.
class HeaderReader {
 public:
  HeaderReader(std::string_view text, PlyHeader& out) : text_(text), out_(out) {}

  Status read() {
    std::size_t offset = 0;
    if (words_of(next_line(text_, offset), 2) != std::vector<std::string_view>{"ply"}) {
      return bad_byte(0, "the file does not begin with a line 'ply'");
    }
    while (true) {
      if (offset == text_.size()) {
        return bad_byte(offset, "the file ends within the PLY header (end_header must close it)");
      }
      const std::size_t begin = offset;
      const auto words = words_of(next_line(text_, offset), longest_line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (Status status = read_line(begin, words); !status.ok()) return status;
    }
    out_.size = offset;
    if (!has_format_) return bad_byte(0, "the PLY header has no line 'format'");
    return {};
  }

 private:
  using Words = std::vector<std::string_view>;
  static constexpr std::size_t longest_line = 6;  // "property list TYPE TYPE NAME" and one too many

  Status read_line(std::size_t begin, const Words& words) {
    if (words[0] == "format") return read_format(begin, words);
    if (words[0] == "element") return read_element(begin, words);
    if (words[0] == "property") return read_property(begin, words);
    return bad_byte(
        begin, "{} is no line of a PLY header (format, element, property, comment, end_header)",
        quote(words[0]));
  }

  Status read_format(std::size_t begin, const Words& words) {
    constexpr std::array<std::string_view, 3> formats{"ascii", "binary_little_endian",
                                                      "binary_big_endian"};
    const auto* const found =
        words.size() == 3 ? std::ranges::find(formats, words[1]) : formats.end();
    if (has_format_ || found == formats.end() || words[2] != "1.0") {
      return bad_byte(begin,
                      "one line 'format ascii 1.0' is allowed, or binary_little_endian or "
                      "binary_big_endian instead of ascii");
    }
    out_.data = static_cast<PlyData>(found - formats.begin());
    has_format_ = true;
    return {};
  }

  Status read_element(std::size_t begin, const Words& words) {
    const auto count = words.size() == 3 ? whole_number<std::size_t>(words[2]) : std::nullopt;
    if (!count) {
      return bad_byte(begin,
                      "an element line is 'element NAME COUNT', COUNT a whole number from 0");
    }
    if (std::ranges::find(out_.elements, words[1], &PlyElement::name) != out_.elements.end()) {
      return bad_byte(begin, "element {} occurs twice", quote(words[1]));
    }
    if (out_.elements.size() == most_elements) {
      return bad_byte(begin, "more than {} elements", most_elements);
    }
    out_.elements.push_back({words[1], *count, {}, begin});
    return {};
  }

  Status read_property(std::size_t begin, const Words& words) {
    if (out_.elements.empty()) return bad_byte(begin, "a property before the first element");
    std::vector<PlyProperty>& properties = out_.elements.back().properties;
    if (properties.size() == max_fields) {
      return bad_byte(begin, "more than {} properties in an element", max_fields);
    }
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3) {
      return bad_byte(begin,
                      "a property line is 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    }
    const auto type = type_named(words[words.size() - 2]);
    const auto length_type = is_list ? type_named(words[2]) : std::nullopt;
    if (!type || (is_list && !(length_type && is_integer(*length_type)))) {
      return bad_byte(begin,
                      "{} is no type of a property (char, uchar, short, ushort, int, uint, float, "
                      "double; list lengths are integers)",
                      quote(type ? words[2] : words[words.size() - 2]));
    }
    properties.push_back({words.back(), *type, length_type, begin});
    return {};
  }

  static constexpr std::size_t most_elements = 64;  // names are compared each with each

  std::string_view text_;
  PlyHeader& out_;
  bool has_format_ = false;
};

}  // namespace

Status read_ply_header(std::string_view text, PlyHeader& out) {
  return HeaderReader(text, out).read();
}

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flagstone::io {

/// The bytes of a file as text, without copying.
inline std::string_view as_text(std::span<const std::byte> bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The text from `offset` to the next newline or the end. Moves `offset` past the newline.
std::string_view next_line(std::string_view text, std::size_t& offset) noexcept;

/// The words of a line, at most the first `limit`. Words are separated as is_blank() defines.
std::vector<std::string_view> words_of(std::string_view line, std::size_t limit);

/// The integer that `word` spells, or nothing if it contains anything else or is out of range.
template <class T>
std::optional<T> whole_number(std::string_view word) noexcept {
  T value = 0;
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// The number that `word` spells, or nothing if it contains anything else. `nan` and `inf` are
/// numbers; a number beyond the range of a double is infinite, one too small for a double is 0.
std::optional<double> real_number(std::string_view word) noexcept;

/// `text` without blanks at both ends.
std::string_view trimmed(std::string_view text) noexcept;

/// Whether `c` separates words on a line.
constexpr bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// The text of a path as the system has it: `char`, on Windows `wchar_t`.
using PathText = std::basic_string_view<std::filesystem::path::value_type>;

/// The last component of `path`. Valid as long as `path`.
PathText file_name(const std::filesystem::path& path) noexcept;

/// The last component of `path` in lower case.
std::string lower_case_name(const std::filesystem::path& path);

/// `c`, in lower case if it is one of A to Z.
template <class Char>
constexpr Char in_lower_case(Char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<Char>(c - 'A' + 'a') : c;
}

/// Whether `name`, in upper or lower case, ends with `ending`, which must be in lower case.
template <class Char>
bool ends_with(std::basic_string_view<Char> name, std::string_view ending) noexcept {
  if (name.size() < ending.size()) return false;
  return std::ranges::equal(name.substr(name.size() - ending.size()), ending, {},
                            in_lower_case<Char>);
}

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flagstone::io {

/// A file's bytes as text.
inline std::string_view as_text(std::span<const std::byte> bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The text from `offset` to the next newline or the end; `offset` moves behind it.
std::string_view next_line(std::string_view text, std::size_t& offset) noexcept;

/// The words of a line, at most `limit` of them; what separates them are spaces, tabs and returns.
std::vector<std::string_view> words_of(std::string_view line, std::size_t limit);

/// A whole number of digits only, or nothing.
template <class T>
std::optional<T> whole_number(std::string_view word) noexcept {
  T value = 0;
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// What separates words on a line.
constexpr bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// The last part of `path`, which must outlive it.
std::string_view file_name(const std::filesystem::path& path) noexcept;

/// The last part of `path` in lower case.
std::string lower_case_name(const std::filesystem::path& path);

/// Whether `name` ends with `ending`, which is in lower case, in any case.
bool ends_with(std::string_view name, std::string_view ending) noexcept;

}  // namespace flagstone::io

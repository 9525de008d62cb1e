// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/text.hpp"

#include <algorithm>
#include <limits>
#include <system_error>

namespace flagstone::io {

std::string_view next_line(std::string_view text, std::size_t& offset) noexcept {
  const std::string_view rest = text.substr(offset);
  const std::string_view line = rest.substr(0, rest.find('\n'));
  offset += std::min(line.size() + 1, rest.size());
  return line;
}

std::vector<std::string_view> words_of(std::string_view line, std::size_t limit) {
  std::vector<std::string_view> words;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (words.size() < limit) {
    const char* const begin = std::find_if_not(at, end, is_blank);
    if (begin == end) break;
    at = std::find_if(begin, end, is_blank);
    words.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
  return words;
}

std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<double> real_number(std::string_view word) noexcept {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const char* const begin = word.data();
  const char* const end = begin + word.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc()) return value;
  const bool is_small =
      word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  return is_small ? 0 : std::numeric_limits<double>::infinity();
}

PathText file_name(const std::filesystem::path& path) noexcept {
  constexpr std::array separators{std::filesystem::path::value_type{'/'},
                                  std::filesystem::path::preferred_separator};
  const PathText text = path.native();
  const std::size_t separator = text.find_last_of(separators.data(), PathText::npos, 2);
  return text.substr(separator + 1);  // npos + 1 is 0
}

std::string lower_case_name(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::ranges::transform(name, name.begin(), in_lower_case<char>);
  return name;
}

}  // namespace flagstone::io

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/text.hpp"

#include <algorithm>

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

namespace {

char in_lower_case(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string_view file_name(const std::filesystem::path& path) noexcept {
  const std::string_view text = path.native();
  return text.substr(text.rfind('/') + 1);  // npos + 1 is 0
}

std::string lower_case_name(const std::filesystem::path& path) {
  std::string name(file_name(path));
  std::ranges::transform(name, name.begin(), in_lower_case);
  return name;
}

bool ends_with(std::string_view name, std::string_view ending) noexcept {
  if (name.size() < ending.size()) return false;
  return std::ranges::equal(name.substr(name.size() - ending.size()), ending, {}, in_lower_case);
}

}  // namespace flagstone::io

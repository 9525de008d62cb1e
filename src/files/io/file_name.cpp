// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/file_name.hpp"

#include <algorithm>

namespace flagstone::io {
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

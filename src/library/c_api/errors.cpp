// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/c_api/errors.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

namespace flagstone::c_api {
namespace {

bool is_control_character(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool continues_a_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

/// The beginning of a UTF-8 text, at most `size` bytes and whole characters.
std::string_view beginning(std::string_view text, std::size_t size) {
  if (text.size() <= size) return text;
  while (size > 0 && continues_a_character(text[size])) --size;
  return text.substr(0, size);
}

}  // namespace

flagstone_status report(flagstone_error* error, flagstone_status status,
                        std::string_view message) noexcept {
  if (error == nullptr) return status;
  const std::string_view text = beginning(message, std::size(error->message) - 1);
  char* const end =
      std::ranges::replace_copy_if(text, error->message, is_control_character, ' ').out;
  *end = '\0';
  return status;
}

void require(const void* pointer, std::string_view name, std::string_view expected) {
  if (pointer != nullptr) return;
  throw std::invalid_argument(std::string(name).append(": is NULL (expected ").append(expected) +
                              ')');
}

void require_index(std::size_t index, std::size_t count) {
  if (index < count) return;
  throw std::invalid_argument("index: " + std::to_string(index) +
                              " is out of range (expected less than " + std::to_string(count) +
                              ')');
}

}  // namespace flagstone::c_api

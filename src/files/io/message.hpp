// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "flagstone/status.hpp"

/// Error messages of the readers and writers; internal to src/files. Every message is one
/// line, `PATH: byte OFFSET: PROBLEM (expected EXPECTED; HINT)`, without the parts that add
/// nothing.
namespace flagstone::io {

/// Quotes text from a file for a message: at most 32 characters, with \xHH for everything except
/// printable ASCII.
std::string quote(std::string_view text);

/// A path for a message: control characters, which could break the line, become \xHH.
std::string printable(const std::filesystem::path& path);

/// `status` with "PATH: " before its message.
Status with_path(const std::filesystem::path& path, Status status);

/// bad_file with the message "byte OFFSET: reason".
template <class... Args>
Status bad_byte(std::size_t offset, fmt::format_string<Args...> reason, Args&&... args) {
  return Status(StatusCode::bad_file, fmt::format("byte {}: ", offset) +
                                          fmt::format(reason, std::forward<Args>(args)...));
}

/// invalid_argument with a formatted reason.
template <class... Args>
Status invalid(fmt::format_string<Args...> reason, Args&&... args) {
  return Status(StatusCode::invalid_argument, fmt::format(reason, std::forward<Args>(args)...));
}

/// invalid_argument with the message "PATH: reason". Never throws.
Status refuse(const std::filesystem::path& path, std::string_view reason);

/// Runs `work`, which returns a Status; a failed allocation becomes out_of_memory.
template <class Work>
Status within_memory(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  } catch (const std::length_error&) {  // from vectors, beyond max_size()
    return Status(StatusCode::out_of_memory);
  }
}

}  // namespace flagstone::io

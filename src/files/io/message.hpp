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

/// How the readers and writers of this folder say what went wrong; internal to it.
namespace flagstone::io {

/// Text from a file as a message may hold it: in quotes, at most 32 characters, anything but
/// printable ASCII as \xHH.
std::string quote(std::string_view text);

/// A path as a message may hold it: control characters, which could break the line, as \xHH.
std::string printable(const std::filesystem::path& path);

/// `status` with "PATH: " before its text.
Status with_path(const std::filesystem::path& path, Status status);

/// bad_file, "byte OFFSET: reason".
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

/// invalid_argument, "PATH: reason"; never throws.
Status refuse(const std::filesystem::path& path, std::string_view reason);

/// Runs `work`, which returns a Status; a failed allocation becomes out_of_memory.
template <class Work>
Status within_memory(Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  } catch (const std::length_error&) {  // what a vector throws beyond its max_size()
    return Status(StatusCode::out_of_memory);
  }
}

}  // namespace flagstone::io

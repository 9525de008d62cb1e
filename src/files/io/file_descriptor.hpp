// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>

namespace flagstone::io {

/// Opens a file to read it. Returns its descriptor; -1 on failure, and errno has the reason.
inline int open_to_read(const std::filesystem::path& path) noexcept {
#ifdef _WIN32
  return ::_wopen(path.c_str(), O_RDONLY | O_BINARY | O_NOINHERIT);
#else
  // Without O_NONBLOCK, opening a pipe waits for a writer.
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
#endif
}

/// Creates a file and opens it to write it. Returns its descriptor; -1 on failure, and errno has
/// the reason: EEXIST if the file exists.
inline int create_to_write(const std::filesystem::path& path) noexcept {
#ifdef _WIN32
  return ::_wopen(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_BINARY | O_NOINHERIT, 0600);
#else
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
#endif
}

/// Owns a file descriptor and closes it on destruction.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) noexcept : number_(number) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;
  ~FileDescriptor() { close(); }

  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }
  [[nodiscard]] int get() const noexcept { return number_; }

  /// Number of bytes read or written; -1 on failure, and errno has the reason.
  std::ptrdiff_t read(std::span<std::byte> to) const noexcept {
    return ::read(number_, to.data(), at_once(to.size()));
  }
  std::ptrdiff_t write(std::span<const std::byte> from) const noexcept {
    return ::write(number_, from.data(), at_once(from.size()));
  }

  /// False if the system could not write all data, which it may report only here.
  bool close() noexcept {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  /// Windows and macOS do not read or write 2^31 bytes or more at once.
  static unsigned at_once(std::size_t size) noexcept {
    return static_cast<unsigned>(std::min(size, std::size_t{1} << 30U));
  }

  int number_;
};

}  // namespace flagstone::io

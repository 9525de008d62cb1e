// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/load_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <string_view>
#include <system_error>

#include "files/io/file_descriptor.hpp"
#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

Status system_error(std::string_view what, int error) {
  const bool is_missing = error == ENOENT || error == ENOTDIR;
  return Status(is_missing ? StatusCode::not_found : StatusCode::unreadable,
                fmt::format("{}: {}", what, std::generic_category().message(error)));
}

/// Says what a thing is that cannot be read as a file.
Status not_a_file(mode_t mode) {
  const char* const kind = S_ISDIR(mode)                    ? "a folder"
                           : S_ISFIFO(mode)                 ? "a pipe"
                           : S_ISSOCK(mode)                 ? "a socket"
                           : S_ISCHR(mode) || S_ISBLK(mode) ? "a device"
                                                            : "something else";
  return Status(StatusCode::unreadable,
                fmt::format("is {} (only regular files are read; copy it into one)", kind));
}

Status read_all(int file, std::span<std::byte> to) {
  for (std::size_t done = 0; done < to.size();) {
    const ssize_t got = ::read(file, to.data() + done, to.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error("cannot be read", errno);
    if (got == 0) {
      return Status(StatusCode::unreadable,
                    fmt::format("byte {}: the file became shorter while it was read (it had {} "
                                "bytes; is it still being written?)",
                                done, to.size()));
    }
    done += static_cast<std::size_t>(got);
  }
  return {};
}

// Without O_NONBLOCK opening a pipe waits until somebody writes to it.
constexpr int reading = O_RDONLY | O_CLOEXEC | O_NONBLOCK;

/// Makes `bytes` exactly that long, clearing as little of it as possible and keeping none.
void resize(std::vector<std::byte>& bytes, std::size_t size) {
  if (size > bytes.capacity()) bytes = {};  // growing would copy what is overwritten anyway
  bytes.resize(size);
}

// Not mapped: from the page cache a map takes up to a third less time, but a file that shrinks
// while mapped ends the program with SIGBUS.
Status read_whole(const std::filesystem::path& path, std::vector<std::byte>& out) {
  const FileDescriptor file(::open(path.c_str(), reading));
  if (!file.is_open()) return system_error("cannot be opened", errno);
  struct stat about{};
  if (::fstat(file.get(), &about) != 0) return system_error("cannot be examined", errno);
  if (!S_ISREG(about.st_mode)) return not_a_file(about.st_mode);
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size > max_file_size) {
    return Status(StatusCode::bad_file,
                  fmt::format("has {} bytes (at most {} are read; split it)", size, max_file_size));
  }
  resize(out, size);
  return read_all(file.get(), out);
}

}  // namespace

Status load_bytes(const std::filesystem::path& path, std::vector<std::byte>& out) {
  Status status = with_path(path, within_memory([&] { return read_whole(path, out); }));
  if (!status.ok()) out.clear();
  return status;
}

void read_ahead(const std::filesystem::path& path) noexcept {
  const FileDescriptor file(::open(path.c_str(), reading));
  if (file.is_open()) ::posix_fadvise(file.get(), 0, 0, POSIX_FADV_WILLNEED);
}

}  // namespace flagstone::io

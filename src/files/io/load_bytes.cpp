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

/// The error for anything that is not a regular file.
Status not_a_file(mode_t mode) {
  const char* const kind = S_ISDIR(mode)                    ? "a directory"
                           : S_ISFIFO(mode)                 ? "a pipe"
                           : S_ISSOCK(mode)                 ? "a socket"
                           : S_ISCHR(mode) || S_ISBLK(mode) ? "a device"
                                                            : "not a regular file";
  return Status(StatusCode::unreadable, fmt::format("is {} (expected a regular file{})", kind,
                                                    S_ISDIR(mode) ? "" : "; copy the data to one"));
}

Status read_all(int file, std::span<std::byte> to) {
  for (std::size_t done = 0; done < to.size();) {
    const ssize_t got = ::read(file, to.data() + done, to.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error("cannot be read", errno);
    if (got == 0) {
      return Status(StatusCode::unreadable,
                    fmt::format("byte {}: the file became shorter while it was read (expected {} "
                                "bytes; another program may still be writing it)",
                                done, to.size()));
    }
    done += static_cast<std::size_t>(got);
  }
  return {};
}

// Without O_NONBLOCK, opening a pipe waits for a writer.
constexpr int reading = O_RDONLY | O_CLOEXEC | O_NONBLOCK;

/// Sets the size of `bytes`. Its old contents are lost, and as little as possible is cleared.
void resize(std::vector<std::byte>& bytes, std::size_t size) {
  if (size > bytes.capacity()) bytes = {};  // growing would copy bytes that are then overwritten
  bytes.resize(size);
}

// Not memory-mapped: mapping takes up to a third less time from the page cache, but a file that
// shrinks while it is mapped ends the program with SIGBUS.
Status read_whole(const std::filesystem::path& path, std::vector<std::byte>& out) {
  const FileDescriptor file(::open(path.c_str(), reading));
  if (!file.is_open()) return system_error("cannot be opened", errno);
  struct stat about{};
  if (::fstat(file.get(), &about) != 0) return system_error("cannot be read", errno);
  if (!S_ISREG(about.st_mode)) return not_a_file(about.st_mode);
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size > max_file_size) {
    return Status(
        StatusCode::bad_file,
        fmt::format("has {} bytes (expected at most {}; split the file)", size, max_file_size));
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/load_bytes.hpp"

#include <sys/stat.h>

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
Status not_a_file(const std::filesystem::path& path) {
  using enum std::filesystem::file_type;
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(path, ignored).type();
  const char* const kind = type == directory                    ? "a directory"
                           : type == fifo                       ? "a pipe"
                           : type == socket                     ? "a socket"
                           : type == character || type == block ? "a device"
                                                                : "not a regular file";
  return Status(StatusCode::unreadable,
                fmt::format("is {} (expected a regular file{})", kind,
                            type == directory ? "" : "; copy the data to one"));
}

/// The error for a file that cannot be opened. Windows does not open directories.
Status not_opened(const std::filesystem::path& path, int error) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return not_a_file(path);
  return system_error("cannot be opened", error);
}

Status read_all(const FileDescriptor& file, std::span<std::byte> to) {
  for (std::size_t done = 0; done < to.size();) {
    const std::ptrdiff_t got = file.read(to.subspan(done));
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

/// Sets the size of `bytes`. Its old contents are lost, and as little as possible is cleared.
void resize(std::vector<std::byte>& bytes, std::size_t size) {
  if (size > bytes.capacity()) bytes = {};  // growing would copy bytes that are then overwritten
  bytes.resize(size);
}

// Not memory-mapped: mapping takes up to a third less time from the page cache, but a file that
// shrinks while it is mapped ends the program with SIGBUS.
Status read_whole(const std::filesystem::path& path, std::vector<std::byte>& out) {
  const FileDescriptor file(open_to_read(path));
  if (!file.is_open()) return not_opened(path, errno);
  struct stat about{};
  if (::fstat(file.get(), &about) != 0) return system_error("cannot be read", errno);
  if (!S_ISREG(about.st_mode)) return not_a_file(path);
  const auto size = static_cast<std::size_t>(about.st_size);
  if (size > max_file_size) {
    return Status(
        StatusCode::bad_file,
        fmt::format("has {} bytes (expected at most {}; split the file)", size, max_file_size));
  }
  resize(out, size);
  return read_all(file, out);
}

}  // namespace

Status load_bytes(const std::filesystem::path& path, std::vector<std::byte>& out) {
  Status status = with_path(path, within_memory([&] { return read_whole(path, out); }));
  if (!status.ok()) out.clear();
  return status;
}

void read_ahead([[maybe_unused]] const std::filesystem::path& path) noexcept {
#ifdef POSIX_FADV_WILLNEED  // neither macOS nor Windows has it
  const FileDescriptor file(open_to_read(path));
  if (file.is_open()) ::posix_fadvise(file.get(), 0, 0, POSIX_FADV_WILLNEED);
#endif
}

}  // namespace flagstone::io

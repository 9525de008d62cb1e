// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/atomic_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include "files/io/file_descriptor.hpp"
#include "files/io/file_size_signal.hpp"
#include "files/io/message.hpp"

namespace flagstone::io {
namespace {

namespace fs = std::filesystem;

Status unwritable(std::string_view what, const std::error_code& error) {
  return Status(StatusCode::unwritable, fmt::format("{}: {}", what, error.message()));
}

Status unwritable(std::string_view what, int error) {
  return unwritable(what, std::error_code(error, std::generic_category()));
}

/// The path of the file itself, with symbolic links resolved. unwritable if renaming would replace
/// something other than a regular file.
Status find_target(const fs::path& path, fs::path& target) {
  target = path;
  std::error_code error;
  if (fs::is_symlink(path, error)) {
    target = fs::canonical(path, error);
    if (error) return unwritable("is a broken symbolic link", error);
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return Status(StatusCode::unwritable,
                  fs::is_directory(status)
                      ? "is a directory (expected a file)"
                      : "is not a regular file (choose a regular file or a new path)");
  }
  return {};
}

/// A temporary file next to the file to be written. The destructor removes it unless it was
/// renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    do {  // skip files left behind by a killed process that had the same process id
      path_ = folder / fmt::format(".flagstone-{}-{}.tmp", ::getpid(), counter++);
      number_ = create_to_write(path_);
    } while (number_ < 0 && errno == EEXIST);
    error_ = number_ < 0 ? errno : 0;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  TemporaryFile(TemporaryFile&&) = delete;
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    if (number_ >= 0 && !is_in_place_) fs::remove(path_, ignored);
  }

  Status fill_and_put_in_place(std::span<const std::byte> bytes, const fs::path& target) {
    if (number_ < 0) return unwritable("cannot be created", error_);
    FileDescriptor file(number_);
    const FileSizeSignalBlocked signal_blocked;
    while (!bytes.empty()) {
      const std::ptrdiff_t written = file.write(bytes);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return unwritable("cannot be written", errno);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    if (!file.close()) return unwritable("cannot be written", errno);
    std::error_code error;
    fs::rename(path_, target, error);
    if (error) return unwritable("cannot be replaced", error);
    is_in_place_ = true;
    return {};
  }

 private:
  fs::path path_;
  int number_ = -1;
  int error_ = 0;
  bool is_in_place_ = false;
};

Status write(const fs::path& path, std::span<const std::byte> bytes) {
  fs::path target;
  if (Status status = find_target(path, target); !status.ok()) return status;
  return TemporaryFile(target.parent_path()).fill_and_put_in_place(bytes, target);
}

}  // namespace

Status write_file(const fs::path& path, std::span<const std::byte> bytes) {
  return with_path(path, within_memory([&] { return write(path, bytes); }));
}

Status write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace flagstone::io

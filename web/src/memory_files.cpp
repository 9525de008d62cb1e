// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "memory_files.hpp"

#include <filesystem>
#include <map>
#include <string_view>

#include "files/io/atomic_file.hpp"
#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"

namespace flagstone {
namespace {

std::map<std::string, std::vector<std::byte>>& files() {
  static std::map<std::string, std::vector<std::byte>> all;
  return all;
}

std::vector<std::byte>& last_written() {
  static std::vector<std::byte> bytes;
  return bytes;
}

}  // namespace

namespace web {

std::span<std::byte> add_file(const std::string& name, std::size_t size) {
  std::vector<std::byte>& bytes = files()[name];
  bytes.resize(size);
  return bytes;
}

void remove_files() noexcept { files().clear(); }

std::span<const std::byte> written_file() noexcept { return last_written(); }

}  // namespace web

namespace io {

Status load_bytes(const std::filesystem::path& path, std::vector<std::byte>& out) {
  const auto file = files().find(path.string());
  if (file == files().end()) {
    return Status(StatusCode::not_found, printable(path) + ": cannot be opened: no such file");
  }
  return with_path(path, within_memory([&] {
                     out.assign(file->second.begin(), file->second.end());
                     return Status();
                   }));
}

void read_ahead(const std::filesystem::path&) noexcept {}

Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  return with_path(path, within_memory([&] {
                     last_written().assign(bytes.begin(), bytes.end());
                     return Status();
                   }));
}

Status write_file(const std::filesystem::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace io
}  // namespace flagstone

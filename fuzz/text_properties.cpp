// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "text_properties.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "cloud_properties.hpp"

namespace flagstone::fuzz {

namespace fs = std::filesystem;

void check_line(std::string_view message) {
  require(!message.empty(), "an error has a message");
  const bool is_printable = std::ranges::all_of(message, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte != 0x7f;
  });
  require(is_printable, "an error is one line without control characters");
}

ScratchFile::ScratchFile(std::string_view name) {
  const fs::path memory = "/dev/shm";
  std::error_code ignored;
  const fs::path folder = (fs::is_directory(memory, ignored) ? memory : fs::temp_directory_path()) /
                          ("flagstone-fuzz-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  path_ = folder / name;
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  fs::remove_all(path_.parent_path(), ignored);
}

void ScratchFile::put(std::string_view contents) const {
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  require(file.good(), "the scratch file can be written");
}

}  // namespace flagstone::fuzz

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

/// Properties of everything that reads text, for any text.
namespace flagstone::fuzz {

/// An error message is one printable line.
void check_line(std::string_view message);

/// A file that is rewritten for every input. It is in a temporary directory of this process, in
/// memory if possible, which is removed at exit.
class ScratchFile {
 public:
  explicit ScratchFile(std::string_view name);
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ScratchFile(ScratchFile&&) = delete;
  ScratchFile& operator=(ScratchFile&&) = delete;
  ~ScratchFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void put(std::string_view contents) const;

 private:
  std::filesystem::path path_;
};

}  // namespace flagstone::fuzz

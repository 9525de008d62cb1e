// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

/// What must hold of everything that reads text, whatever the text.
namespace flagstone::fuzz {

/// An error's message is one line that can be printed.
void check_line(std::string_view message);

/// A file that is written anew for every input, in a folder of this process in memory where there
/// is such, and removed in the end.
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

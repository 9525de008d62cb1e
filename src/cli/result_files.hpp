// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <functional>
#include <string>

namespace flagstone::cli {

/// The options that say which files results are written to; empty for none.
struct ResultFiles {
  std::string json, csv, html;

  /// Adds the options to a command.
  void add_to(CLI::App& command);

  /// Where finished scans are kept while a run lasts: beside the first of them; empty for nowhere.
  [[nodiscard]] std::filesystem::path checkpoint() const;

  /// Looks whether they can be written, before the work that would be lost else, and makes their
  /// folders. Throws std::invalid_argument or std::runtime_error with one line.
  void prepare() const;
};

/// Writes `text` to a file of results, if one is named, and says so. Throws std::runtime_error with
/// one line.
void write_result(const std::string& file, const std::function<std::string()>& text);

/// Makes a folder, and those above it. Throws std::runtime_error with one line.
void make_folder(const std::filesystem::path& folder);

}  // namespace flagstone::cli

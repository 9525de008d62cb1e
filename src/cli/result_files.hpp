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
  [[nodiscard]] std::filesystem::path journal() const;

  /// Writes those that are asked for, making their folders, and says so. Throws std::runtime_error
  /// with one line.
  void write(const std::function<std::string()>& json_text,
             const std::function<std::string()>& csv_text,
             const std::function<std::string()>& html_text) const;
};

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/result_files.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/atomic_file.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

void ResultFiles::add_to(CLI::App& command) {
  command.add_option("--json", json, "Write the results as JSON")->type_name("FILE");
  command.add_option("--csv", csv, "Write the results as CSV")->type_name("FILE");
  command.add_option("--html", html, "Write a report to look at: one self-contained file")
      ->type_name("FILE");
}

fs::path ResultFiles::journal() const {
  for (const std::string& file : {json, csv, html}) {
    if (!file.empty()) return file + ".journal";
  }
  return {};
}

void ResultFiles::write(const std::function<std::string()>& json_text,
                        const std::function<std::string()>& csv_text,
                        const std::function<std::string()>& html_text) const {
  const std::array files = {std::pair(&json, &json_text), std::pair(&csv, &csv_text),
                            std::pair(&html, &html_text)};
  for (const auto& [file, text] : files) {
    if (file->empty()) continue;
    const fs::path path = *file;
    const Status status = io::write_file(path, std::string_view((*text)()));
    if (!status.ok()) throw std::runtime_error(status.message());
    fmt::print("wrote {}\n", *file);
  }
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/result_files.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>
#include <system_error>

#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

void ResultFiles::add_to(CLI::App& command) {
  command.add_option("--json", json, "Write the results as JSON")->type_name("FILE");
  command.add_option("--csv", csv, "Write the results as CSV")->type_name("FILE");
  command.add_option("--html", html, "Write a report to look at: one self-contained file")
      ->type_name("FILE");
}

fs::path ResultFiles::checkpoint() const {
  for (const std::string& file : {json, csv, html}) {
    if (!file.empty()) return file + ".checkpoint";
  }
  return {};
}

void ResultFiles::prepare() const {
  std::set<fs::path> names;
  for (const std::string& file : {json, csv, html}) {
    if (file.empty()) continue;
    const fs::path path = fs::path(file).lexically_normal();
    std::error_code error;
    if (fs::is_directory(path, error)) {
      throw std::invalid_argument(fmt::format("{}: is a folder; name a file", file));
    }
    if (!names.insert(path).second) {
      throw std::invalid_argument(
          fmt::format("{}: is named twice; --json, --csv and --html are files of their own", file));
    }
    if (path.has_parent_path()) make_folder(path.parent_path());
  }
}

void write_result(const std::string& file, const std::function<std::string()>& text) {
  if (file.empty()) return;
  const fs::path path = file;
  const Status status = io::write_file(path, std::string_view(text()));
  if (!status.ok()) throw std::runtime_error(status.message());
  fmt::print("wrote {}\n", io::printable(path));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  }
}

}  // namespace flagstone::cli

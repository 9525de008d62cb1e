// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/scan_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <system_error>

#include "files/io/read_cloud.hpp"
#include "files/io/text.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

namespace {

std::vector<ScanInput> scans_below(const fs::path& folder) {
  std::vector<ScanInput> scans;
  std::error_code error;
  fs::recursive_directory_iterator walk(folder, fs::directory_options::skip_permission_denied,
                                        error);
  for (; !error && walk != fs::recursive_directory_iterator(); walk.increment(error)) {
    if (!walk->is_regular_file(error) || !io::is_scan_name(walk->path())) continue;
    scans.push_back(
        {walk->path(), without_scan_extension(walk->path().lexically_relative(folder))});
  }
  if (error) {
    throw std::invalid_argument(
        fmt::format("{}: cannot be walked: {}", folder.string(), error.message()));
  }
  if (scans.empty()) {
    throw std::invalid_argument(fmt::format(
        "{}: no scan in this folder or below it; scans end in .bin, .pcd.bin, .pcd, .ply or .npy",
        folder.string()));
  }
  std::ranges::sort(scans, {}, &ScanInput::file);
  return scans;
}

}  // namespace

fs::path without_scan_extension(const fs::path& file) {
  fs::path stem = file;
  stem.replace_extension();
  if (io::lower_case_name(file).ends_with(".pcd.bin")) stem.replace_extension();
  return stem;
}

std::vector<ScanInput> find_scans(const std::vector<std::string>& paths) {
  std::vector<ScanInput> scans;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      std::ranges::move(scans_below(path), std::back_inserter(scans));
    } else {
      scans.push_back({path, without_scan_extension(fs::path(path).filename())});
    }
  }
  return scans;
}

std::vector<ScanInput> list_scans(const std::vector<std::string>& paths) {
  std::vector<ScanInput> scans = find_scans(paths);
  std::map<fs::path, fs::path> taken;
  for (const ScanInput& scan : scans) {
    const auto [other, is_new] = taken.emplace(scan.output_stem, scan.file);
    if (!is_new) {
      throw std::invalid_argument(fmt::format(
          "{} and {} would both write to {}.*; name a folder above both, or run them apart",
          other->second.string(), scan.file.string(), scan.output_stem.string()));
    }
  }
  return scans;
}

}  // namespace flagstone::cli

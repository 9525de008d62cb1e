// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/found_files.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace flagstone::eval {
namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// Path of the labels of scan "05/000120" in a tree with the layout of its dataset:
/// sequences/05/SUBDIRECTORY/000120.label. With several datasets, each has a directory with its
/// name.
fs::path in_tree(const fs::path& folder, const fs::path& name, const char* subdirectory,
                 const char* extension = ".label") {
  const fs::path file = fs::path(subdirectory) / (name.filename().string() + extension);
  const fs::path sequence = name.parent_path();
  if (sequence.empty()) return folder / file;
  return folder / sequence.parent_path() / "sequences" / sequence.filename() / file;
}

/// The directories that can be a mapped run with this scan.
std::vector<fs::path> possible_runs(const fs::path& folder, const LabelledScan& scan) {
  const fs::path sequence = fs::path(scan.name).parent_path();
  std::vector<fs::path> runs = {sequence.empty() ? folder : folder / sequence};
  if (scan.is_of_only_sequence && !sequence.empty()) runs.push_back(folder);
  return runs;
}

/// The mapped run that contains a scan.
std::optional<fs::path> mapped_run(const fs::path& folder, const LabelledScan& scan) {
  for (fs::path& run : possible_runs(folder, scan)) {
    if (is_there(run / "run.json")) return std::move(run);
  }
  return std::nullopt;
}

/// The first file that exists, or the first of all.
fs::path first_existing(const std::vector<fs::path>& candidates) {
  const auto found = std::ranges::find_if(candidates, is_there);
  return found == candidates.end() ? candidates.front() : *found;
}

}  // namespace

LabelFile label_file(const fs::path& folder, const LabelledScan& scan) {
  const std::string& name = scan.name;
  if (const std::optional<fs::path> run = mapped_run(folder, scan)) {
    const std::string stem = fs::path(name).filename().string();
    const bool has_heights = is_there(*run / "heights");
    return {.path = *run / "labels" / (stem + ".label"),
            .is_mapped = true,
            .heights = has_heights ? *run / "heights" / (stem + ".heights.npy") : fs::path()};
  }
  return {.path = first_existing({folder / (name + ".label"), folder / (name + ".npy"),
                                  folder / (name + ".label.npy"),        // of --format u8
                                  in_tree(folder, name, "predictions"),  // SemanticKITTI's layout
                                  in_tree(folder, name, "velodyne"),     // 'flagstone segment TREE'
                                  in_tree(folder, name, "velodyne", ".label.npy")})};
}

fs::path moving_file(const fs::path& folder, const LabelledScan& scan) {
  const std::string& name = scan.name;
  const std::string file = fs::path(name).filename().string() + ".moving.npy";
  if (const std::optional<fs::path> run = mapped_run(folder, scan)) return *run / "moving" / file;
  std::vector<fs::path> candidates = {folder / (name + ".npy")};
  for (const fs::path& run : possible_runs(folder, scan)) {
    candidates.push_back(run / "moving" / file);
    candidates.push_back(run / file);
  }
  candidates.push_back(folder / (name + ".label"));
  candidates.push_back(in_tree(folder, name, "predictions"));  // SemanticKITTI's layout
  return first_existing(candidates);
}

}  // namespace flagstone::eval

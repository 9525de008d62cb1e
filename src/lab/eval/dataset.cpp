// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "files/io/message.hpp"
#include "files/io/read_cloud.hpp"

namespace flagstone::eval {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view lidarseg_ending = ".pcd.bin";

/// Lists the entries of a directory, sorted by name. `entries` is empty after an error.
Status entries_of(const fs::path& folder, std::vector<fs::path>& entries) {
  std::error_code error;
  entries.clear();
  for (fs::directory_iterator walk(folder, error); !error && walk != fs::directory_iterator();
       walk.increment(error)) {
    entries.push_back(walk->path());
  }
  if (error) {
    return Status(StatusCode::unreadable,
                  fmt::format("{}: cannot be listed: {}", io::printable(folder), error.message()));
  }
  std::ranges::sort(entries);
  return {};
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Adds the scans of a directory with velodyne/ and labels/. Scans without labels are skipped; it
/// is an error if no scan has labels.
Status add_velodyne(const fs::path& folder, const std::string& prefix, std::size_t every,
                    std::vector<LabelledScan>& scans) {
  std::vector<fs::path> files;
  if (Status status = entries_of(folder / "velodyne", files); !status.ok()) return status;
  std::size_t labelled = 0;
  for (const fs::path& file : files) {
    if (!io::is_scan_name(file)) continue;
    const fs::path labels = folder / "labels" / (file.stem().string() + ".label");
    if (!is_file(labels)) continue;
    if (labelled++ % every != 0) continue;
    const fs::path ground = folder / "ground" / (file.stem().string() + ".ground.npy");
    scans.push_back({.name = prefix + file.stem().string(),
                     .points = file,
                     .labels = labels,
                     .ground = is_file(ground) ? ground : fs::path()});
  }
  if (labelled == 0) {
    return io::refuse(
        folder,
        "no scan in velodyne/ has labels (expected labels/NAME.label for velodyne/NAME.bin)");
  }
  return {};
}

/// The directory that contains the sequences: `folder` itself or its sequences/; empty if neither
/// does.
fs::path folder_of_sequences(const fs::path& folder) {
  if (is_folder(folder / "sequences")) return folder / "sequences";
  std::vector<fs::path> entries;
  if (is_folder(folder / "velodyne") || !entries_of(folder, entries).ok()) return {};
  const bool has_sequences = std::ranges::any_of(
      entries, [](const fs::path& entry) { return is_folder(entry / "velodyne"); });
  return has_sequences ? folder : fs::path();
}

Status add_tree(const fs::path& folder, const Selection& selection,
                std::vector<LabelledScan>& scans) {
  std::vector<fs::path> sequences;
  if (selection.sequences.empty()) {
    std::vector<fs::path> entries;
    if (Status status = entries_of(folder, entries); !status.ok()) return status;
    std::ranges::copy_if(entries, std::back_inserter(sequences), [](const fs::path& sequence) {
      return is_folder(sequence / "velodyne") && is_folder(sequence / "labels");
    });
  } else {
    for (const std::string& name : selection.sequences) {
      sequences.push_back(folder / name);
    }
  }
  if (sequences.empty()) {
    return io::refuse(folder,
                      "no sequence has both velodyne/ and labels/ (SemanticKITTI's labels are a "
                      "separate download)");
  }
  for (const fs::path& sequence : sequences) {
    const std::string prefix = sequence.filename().string() + "/";
    Status status = add_velodyne(sequence, prefix, selection.every, scans);
    if (!status.ok()) return status;
  }
  return {};
}

Status add_lidarseg(const fs::path& folder, std::size_t every, std::vector<LabelledScan>& scans) {
  std::vector<fs::path> files;
  if (Status status = entries_of(folder, files); !status.ok()) return status;
  std::size_t labelled = 0;
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    if (!name.ends_with(lidarseg_ending)) continue;
    const std::string stem = name.substr(0, name.size() - lidarseg_ending.size());
    const fs::path labels = folder / (stem + "_lidarseg.bin");
    if (!is_file(labels)) continue;
    if (labelled++ % every == 0) scans.push_back({stem, file, labels});
  }
  if (labelled > 0) return {};
  return io::refuse(folder,
                    "not a dataset (expected a directory with sequences/NN/velodyne/ and "
                    "sequences/NN/labels/, with velodyne/ and labels/, or with NAME.pcd.bin and "
                    "NAME_lidarseg.bin)");
}

}  // namespace

Status list_dataset(const fs::path& folder, const Selection& selection,
                    std::vector<LabelledScan>& scans) {
  if (!is_folder(folder)) return io::refuse(folder, "no such directory");
  const std::size_t every = std::max<std::size_t>(selection.every, 1);
  if (const fs::path tree = folder_of_sequences(folder); !tree.empty()) {
    return add_tree(tree, {selection.sequences, every}, scans);
  }
  if (!selection.sequences.empty()) {
    return io::refuse(folder, fmt::format("has no sequences/ to select {} from",
                                          fmt::join(selection.sequences, ", ")));
  }
  if (is_folder(folder / "velodyne")) return add_velodyne(folder, "", every, scans);
  return add_lidarseg(folder, every, scans);
}

}  // namespace flagstone::eval

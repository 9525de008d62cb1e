// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::eval {

/// A scan and its ground-truth classes.
struct LabelledScan {
  std::string name;  ///< "05/000120" in a SemanticKITTI tree, "000120" elsewhere
  std::filesystem::path points;
  std::filesystem::path labels;
  std::filesystem::path ground{};    ///< true height of the ground at each point; empty if unknown
  bool is_of_only_sequence = false;  ///< all scans to evaluate are of one sequence
};

/// Which scans of a dataset are used.
struct Selection {
  std::vector<std::string> sequences;  ///< "05"; empty for all that have labels
  std::size_t every = 1;  ///< use every N-th scan of each sequence, starting with the first
};

/// Lists the labelled scans of a dataset directory, sequence by sequence, sorted by name:
/// - a SemanticKITTI tree, `sequences/NN/velodyne/*.bin` with `sequences/NN/labels/*.label`, or its
/// directory `sequences`; the simulator writes this layout too. Sequences without labels are
/// skipped unless they are selected by name;
/// - a directory with `velodyne/` and `labels/`;
/// - nuScenes-lidarseg files in one directory, `NAME.pcd.bin` and `NAME_lidarseg.bin`.
/// `ground/NAME.ground.npy` next to `velodyne/` contains the true ground heights of simulated
/// scans.
///
/// Errors, each with a one-line message: invalid_argument if the directory has none of these
/// layouts or no labelled scan, or if selected sequences do not exist; unreadable.
Status list_dataset(const std::filesystem::path& folder, const Selection& selection,
                    std::vector<LabelledScan>& scans);

}  // namespace flagstone::eval

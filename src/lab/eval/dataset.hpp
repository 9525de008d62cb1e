// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "flagstone/status.hpp"

namespace flagstone::eval {

/// A scan and its true classes.
struct LabelledScan {
  std::string name;  ///< "05/000120" in a SemanticKITTI tree, "000120" elsewhere
  std::filesystem::path points;
  std::filesystem::path labels;
  std::filesystem::path ground{};  ///< true height of the ground at each point; empty if unknown
};

/// Which scans of a dataset are taken.
struct Selection {
  std::vector<std::string> sequences;  ///< "05"; empty for all that have labels
  std::size_t every = 1;               ///< of each sequence, one scan in this many, from the first
};

/// Lists the labelled scans of a folder, sequence by sequence, each in the order of its names:
/// - a SemanticKITTI tree, `sequences/NN/velodyne/*.bin` with `sequences/NN/labels/*.label`, which
///   is what the simulator writes too, or its folder `sequences` itself; sequences without labels
///   are skipped unless they are selected by name;
/// - a folder with `velodyne/` and `labels/`;
/// - nuScenes-lidarseg files beside each other, `NAME.pcd.bin` and `NAME_lidarseg.bin`.
/// `ground/NAME.ground.npy` beside `velodyne/` tells where the ground is, as the simulator knows
/// it.
///
/// invalid_argument for a folder that is none of these or has no labelled scan, and for sequences
/// asked for where there are none; unreadable. One line that says what was looked for.
Status list_dataset(const std::filesystem::path& folder, const Selection& selection,
                    std::vector<LabelledScan>& scans);

}  // namespace flagstone::eval

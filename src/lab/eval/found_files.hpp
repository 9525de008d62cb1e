// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "lab/eval/dataset.hpp"

/// Finds the files of one scan in the output directory of another program or of `flagstone map`.
namespace flagstone::eval {

/// Labels of a scan.
struct LabelFile {
  std::filesystem::path path;
  /// Labels of a mapped run, which always have flagstone's codes.
  bool is_mapped = false;
  std::filesystem::path heights{};  ///< heights of the mapped run; empty if it has none
};

/// The file with the labels of scan NAME, or the file that is expected if none exists:
/// - in a mapped run (a directory with run.json), labels/NAME.label. Each sequence can have a
///   mapped run: 05/run.json and 05/labels/000120.label for scan 05/000120. If all scans are of one
///   sequence, the directory itself can be the mapped run;
/// - NAME.label, NAME.npy or NAME.label.npy;
/// - sequences/05/predictions/000120.label or sequences/05/velodyne/000120.label for 05/000120.
LabelFile label_file(const std::filesystem::path& folder, const LabelledScan& scan);

/// The file with the moving points of scan NAME, or the file that is expected if none exists:
/// - moving/NAME.moving.npy of a mapped run, as for label_file(), or NAME.moving.npy;
/// - NAME.npy or NAME.label;
/// - sequences/05/predictions/000120.label for 05/000120.
std::filesystem::path moving_file(const std::filesystem::path& folder, const LabelledScan& scan);

}  // namespace flagstone::eval

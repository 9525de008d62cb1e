// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "files/io/label_files.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::eval {

/// What is evaluated: a segmenter, or labels that any other program made.
struct Method {
  std::string name;                    ///< as make_segmenter() knows it, or as the user calls it
  std::string title;                   ///< as the paper's Table I has it
  std::optional<MethodConfig> config;  ///< none for labels made elsewhere
  MountSettings mount{};               ///< `estimate` and `track`: from each scan for itself

  /// Labels made elsewhere: NAME.label or NAME.npy of each scan, or SemanticKITTI's
  /// sequences/NN/predictions/NNNNNN.label, or what `flagstone segment` makes of the dataset's
  /// folder, sequences/NN/velodyne/NNNNNN.label.
  std::filesystem::path labels;
  io::LabelMap label_map = io::LabelMap::flagstone;
};

/// A method of make_segmenter() with these settings.
Method method_of(std::string_view name, MethodConfig config, const MountSettings& mount = {});

}  // namespace flagstone::eval

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

/// A method to evaluate: a segmenter, or labels written by another program.
struct Method {
  std::string name;   ///< its name for make_segmenter(), or a name given by the user
  std::string title;  ///< its name in Table I of the paper
  std::optional<MethodConfig> config;  ///< unset for labels of another program
  MountSettings mount{};               ///< `estimate` and `track` use each scan separately

  /// Directory with labels of another program: NAME.label or NAME.npy per scan, SemanticKITTI's
  /// sequences/NN/predictions/NNNNNN.label, or sequences/NN/velodyne/NNNNNN.label as written by
  /// `flagstone segment` for the dataset directory.
  std::filesystem::path labels;
  io::LabelMap label_map = io::LabelMap::flagstone;
};

/// A method of make_segmenter() with these settings.
Method method_of(std::string_view name, MethodConfig config, const MountSettings& mount = {});

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "flagstone/segmenter.hpp"

namespace flagstone::tests {

/// A method in tests that apply to all methods.
struct Method {
  std::string name;
  /// Makes a segmenter with default settings: sensor height 1.73 m, as in KITTI and in random
  /// clouds.
  std::unique_ptr<Segmenter> (*make)();
  /// Maximum number of 4,000 labels that a different order of points may change: points within
  /// rounding of a threshold, and the few points of the same small patch. Unset if labels depend on
  /// the order.
  std::optional<std::size_t> order_tolerance;
  /// Mean F1 measured independently on 17 to 29 KITTI scans, percent, per protocol.
  double f1_patchwork = 0;
  double f1_patchwork_plusplus = 0;
  /// Whether labels of points depend only on their patch.
  bool labels_follow_patches = true;
};

/// All methods.
std::vector<Method> methods();

/// Methods with labels that do not depend on the order of points.
std::vector<Method> order_free_methods();

/// Name of the method in GoogleTest.
inline std::string name_of(const testing::TestParamInfo<Method>& info) { return info.param.name; }
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

}  // namespace flagstone::tests

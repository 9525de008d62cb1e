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

/// A method as the tests that hold for all of them see it.
struct Method {
  std::string name;
  /// Makes one with its initial settings: the sensor 1.73 m above ground, as on KITTI's car and in
  /// made-up clouds.
  std::unique_ptr<Segmenter> (*make)();
  /// How many of 4,000 labels another order of the points may change: points within rounding of a
  /// threshold, and with one the few of its small patch. Unset: labels depend on the order.
  std::optional<std::size_t> order_tolerance;
  /// Mean F1 measured elsewhere on 17 to 29 KITTI scans, percent, by protocol.
  double f1_patchwork = 0;
  double f1_patchwork_plusplus = 0;
  /// A point is ground by what was said of its patch.
  bool labels_follow_patches = true;
};

/// All of them.
std::vector<Method> methods();

/// Those whose labels do not depend on the order of the points.
std::vector<Method> order_free_methods();

/// What GoogleTest calls a test of the method.
inline std::string name_of(const testing::TestParamInfo<Method>& info) { return info.param.name; }
inline void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

}  // namespace flagstone::tests

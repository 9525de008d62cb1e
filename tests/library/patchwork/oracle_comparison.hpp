// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::oracle {

/// Points and patches on which Patchwork and the oracle differ.
struct Difference {
  std::size_t points = 0;
  std::size_t different_labels = 0;
  std::size_t patches = 0;
  std::size_t different_verdicts = 0;
  double largest_normal_error = 0;  ///< 1 - |cos| between normals, for patches with equal labels

  Difference& operator+=(const Difference& other);
};

/// Compares both on a cloud.
Difference compare(CloudView cloud, const PatchworkConfig& config);

/// Prints the difference. Expects at most 1 of 10,000 labels and 1 of 1,000 patches to differ,
/// because of points within rounding of a threshold.
void expect_agreement(const std::string& what, const Difference& difference);

}  // namespace flagstone::oracle

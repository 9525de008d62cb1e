// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::oracle {

/// Points and patches on which product and oracle differ.
struct Difference {
  std::size_t points = 0;
  std::size_t different_labels = 0;
  std::size_t patches = 0;
  std::size_t different_verdicts = 0;
  double largest_normal_error = 0;  ///< 1 - |cos| between normals where verdicts and labels agree

  Difference& operator+=(const Difference& other);
};

/// What the two make of a cloud.
Difference compare(CloudView cloud, const PatchworkConfig& config);

/// Prints the difference and expects at most 1 label in 10,000 and 1 verdict in 1,000 to be others:
/// points within rounding of a threshold.
void expect_agreement(const std::string& what, const Difference& difference);

}  // namespace flagstone::oracle

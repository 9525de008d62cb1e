// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "clouds.hpp"

namespace flagstone::performance {

/// A kind of scan: ordinary or adversarial.
struct ScanKind {
  std::string name;
  bool ordinary;  ///< real or simulated scans in sensor order
  /// Creates a random scan with `count` points.
  std::function<Cloud(std::size_t count, Random& random)> draw;
};

/// Scans from which others are made.
struct Sources {
  std::vector<Cloud> simulated;
  std::map<std::string, std::vector<Cloud>> real;  ///< by data set, in sensor order
  std::vector<Cloud> voxel_means;                  ///< real, not in sensor order
};

/// Simulated streets, and the finite points of the scans in FLAGSTONE_DATA if it is set.
Sources load_sources();

/// All kinds. Kinds of real scans are omitted without real scans. `sources` must outlive the
/// result.
std::vector<ScanKind> scan_kinds(const Sources& sources);

}  // namespace flagstone::performance

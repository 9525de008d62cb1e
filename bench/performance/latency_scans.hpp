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

/// A kind of scan: ordinary ones, and those that somebody would send who wants a scan to take long.
struct ScanKind {
  std::string name;
  bool ordinary;  ///< sensors deliver such scans in this order
  /// Draws a scan of that many points.
  std::function<Cloud(std::size_t count, Random& random)> draw;
};

/// Scans to make others from.
struct Sources {
  std::vector<Cloud> simulated;
  std::map<std::string, std::vector<Cloud>> real;  ///< by sensor, in its order
  std::vector<Cloud> voxel_means;                  ///< real, in no sensor's order
};

/// Simulated streets, and the scans in FLAGSTONE_DATA without points that are not finite, as far as
/// that is set and there.
Sources load_sources();

/// All kinds; those of real scans are left out where there are none. `sources` must outlive them.
std::vector<ScanKind> scan_kinds(const Sources& sources);

}  // namespace flagstone::performance

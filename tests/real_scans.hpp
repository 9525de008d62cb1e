// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flagstone::tests {

/// A row of index.csv in the directory of real scans.
struct RealScan {
  std::string set;   ///< "kitti", "nuscenes", ...
  std::string name;  ///< "00-000000"
  std::filesystem::path points;
  std::filesystem::path labels;  ///< empty if there are none
  float sensor_height = 0;       ///< metres; 0 if it is unknown
  std::size_t point_count = 0;

  /// True unless the scan contains voxel means instead of the original points.
  [[nodiscard]] bool is_full_density() const { return name.find("-sub") == std::string::npos; }
};

/// The directory of real scans: the environment variable FLAGSTONE_DATA, or ../shared/data next to
/// the source tree.
std::filesystem::path real_scan_folder();

/// The scans of one set, or of all sets for "". Empty if the directory does not exist: tests are
/// then skipped with a message.
std::vector<RealScan> real_scans(const std::string& set = "");

}  // namespace flagstone::tests

/// Skips a test if there are no real scans.
#define FLAGSTONE_REQUIRE_SCANS(scans)                                            \
  if ((scans).empty()) {                                                          \
    GTEST_SKIP() << "no real scans in " << ::flagstone::tests::real_scan_folder() \
                 << "; set FLAGSTONE_DATA to the directory with index.csv";       \
  }

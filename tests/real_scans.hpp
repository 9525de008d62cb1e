// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace flagstone::tests {

/// A row of index.csv in the folder of real scans.
struct RealScan {
  std::string set;   ///< "kitti", "nuscenes", ...
  std::string name;  ///< "00-000000"
  std::filesystem::path points;
  std::filesystem::path labels;  ///< empty where there are none
  float sensor_height = 0;       ///< metres; 0 where there is none
  std::size_t point_count = 0;

  /// KITTI's own density: not the voxel means.
  [[nodiscard]] bool is_full_density() const { return name.find("-sub") == std::string::npos; }
};

/// The folder of real scans: the environment variable FLAGSTONE_DATA, else ../shared/data beside
/// the source tree.
std::filesystem::path real_scan_folder();

/// The scans of one set, or of all for "". Empty where the folder is not there: tests then skip and
/// say so.
std::vector<RealScan> real_scans(const std::string& set = "");

}  // namespace flagstone::tests

/// Skips a test that needs real scans where there are none.
#define FLAGSTONE_REQUIRE_SCANS(scans)                                            \
  if ((scans).empty()) {                                                          \
    GTEST_SKIP() << "no real scans in " << ::flagstone::tests::real_scan_folder() \
                 << "; set FLAGSTONE_DATA to the folder that holds index.csv";    \
  }

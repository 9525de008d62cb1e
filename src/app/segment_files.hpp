// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/output_plan.hpp"
#include "app/run.hpp"
#include "app/scan_files.hpp"
#include "app/scan_report.hpp"
#include "app/segment_scan.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::app {

/// How the sensor of a run is mounted, found from one of its scans.
struct FoundMount {
  MountSettings settings;      ///< what all scans are segmented with: fixed
  MountDecision decision;      ///< of the scan that determines it, or of the last examined
  std::filesystem::path scan;  ///< that scan; empty if none can be read
  std::size_t asked = 0;       ///< scans examined
};

/// Examines at most this many scans.
inline constexpr std::size_t most_scans_asked = 20;

/// Examines the scans in order, before any is segmented, so that the labels do not depend on how
/// many are segmented at once. If no scan determines the mount, the given one applies. Scans that
/// cannot be read are skipped. `settings.height` or `tilt` is `estimate`.
FoundMount find_mount(std::span<const ScanInput> scans, const MountSettings& settings,
                      const io::ReadOptions& read, const RunCallbacks& callbacks = {});

/// What was decided and why, one line.
std::string to_text(const FoundMount& found);

/// Which scans to segment, and how.
struct SegmentRequest {
  std::vector<std::string> scans;  ///< files, and folders of them
  ScanJob job;
  bool label_map_given = false;  ///< only label files have codes
  unsigned threads = 0;          ///< 0: all cores
  OutputPlan plan{};             ///< the files that settings came from
};

struct SegmentCallbacks {
  RunCallbacks run{};
  std::function<void(const FoundMount&)> mount{};   ///< before the first scan
  std::function<void(const ScanReport&)> report{};  ///< in the order of the scans
};

struct SegmentOutcome {
  std::size_t scans = 0;
  std::vector<ScanReport> reports;  ///< of the scans that are done
  CrewTime time;

  /// Is every scan done, without an error?
  [[nodiscard]] bool ok() const;
};

/// Segments scans and writes their labels, clouds, heights, surfaces and pictures. A scan that
/// fails costs its own outputs only. Throws std::invalid_argument with one line before anything is
/// written if the request does not fit together, or if an output would overwrite an input.
SegmentOutcome segment_files(SegmentRequest request, const SegmentCallbacks& callbacks);

}  // namespace flagstone::app

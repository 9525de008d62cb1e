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

/// The mounting pose of the sensor of a run, estimated from one of its scans.
struct FoundMount {
  MountSettings settings;      ///< for all scans: height and tilt are fixed
  MountDecision decision;      ///< for the scan that determined it, or the last one examined
  std::filesystem::path scan;  ///< that scan; empty if none can be read
  std::size_t asked = 0;       ///< scans examined
};

/// find_mount() examines at most this many scans.
inline constexpr std::size_t most_scans_asked = 20;

/// Estimates the mounting pose from the first scan that determines it. If no scan does, the
/// configured pose is used. Scans that cannot be read are skipped. Call it before any scan is
/// segmented, so that the labels do not depend on the number of threads. `settings.height` or
/// `tilt` must be `estimate`.
FoundMount find_mount(std::span<const ScanInput> scans, const MountSettings& settings,
                      const io::ReadOptions& read, const RunCallbacks& callbacks = {});

/// The decision and its reason, on one line.
std::string to_text(const FoundMount& found);

/// The scans to segment, and how.
struct SegmentRequest {
  std::vector<std::string> scans;  ///< files and directories
  ScanJob job;
  bool label_map_given = false;  ///< is an error if the format has no codes
  unsigned threads = 0;          ///< 0: all cores
  OutputPlan plan{};             ///< with the files that settings come from
};

struct SegmentCallbacks {
  RunCallbacks run{};
  std::function<void(const FoundMount&)> mount{};   ///< before the first scan
  std::function<void(const ScanReport&)> report{};  ///< in the order of the scans
};

struct SegmentOutcome {
  std::size_t scans = 0;
  std::vector<ScanReport> reports;  ///< one per finished scan
  RunTime time;

  /// True if every scan is done without an error.
  [[nodiscard]] bool ok() const;
};

/// Segments scans and writes their labels, clouds, heights, surfaces and images. A failed scan
/// does not affect the others. Throws std::invalid_argument, before anything is written, if options
/// contradict each other or if an output would overwrite an input.
SegmentOutcome segment_files(SegmentRequest request, const SegmentCallbacks& callbacks);

}  // namespace flagstone::app

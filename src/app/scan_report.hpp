// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flagstone/label.hpp"
#include "flagstone/mount.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::app {

/// Result of comparing labels with the ground truth under one protocol.
struct Score {
  std::string protocol;
  eval::Confusion confusion;
};

/// The mounting pose that was used for a scan.
struct MountReport {
  Mount mount;             ///< used to segment the scan
  MountDecision decision;  ///< for this scan, or for the scan that determined the pose
};

/// Outcome of one scan.
struct ScanReport {
  std::filesystem::path file;
  std::optional<std::string> error;  ///< one line; if set, the rest is not filled in

  std::size_t points = 0;
  std::array<std::size_t, label_count> counts{};
  std::size_t patches = 0;
  std::size_t file_size = 0;  ///< bytes read
  double read_ms = 0;
  double segment_ms = 0;
  double write_ms = 0;    ///< labels or clouds, without images
  double picture_ms = 0;  ///< 0 without images
  std::vector<Score> scores;
  std::optional<MountReport> mount;  ///< if it was estimated
  bool mount_is_own = false;         ///< estimated from this scan; text_line() prints it
  std::vector<std::filesystem::path> outputs;

  [[nodiscard]] double ground_share() const noexcept;
};

/// A hint for the user if most points are out of range; otherwise empty.
std::string hint_of(const ScanReport& report);

/// One line of text.
std::string text_line(const ScanReport& report);

/// One JSON object, without line breaks.
std::string json_line(const ScanReport& report);

/// Lines of text for the end of a run: number of scans, median time, mean scores.
std::string summary_text(std::span<const ScanReport> reports);

/// Duration of a run, and its number of workers.
struct RunTime {
  double seconds = 0;
  std::size_t workers = 1;
};

/// One line of text: scans and megabytes (10^6 bytes) per second, how the workers spent their time,
/// and whether file I/O or segmentation is the bottleneck. "Other" is images, scores, printing and
/// waiting. Failed scans do not count. Empty if no scan is left.
std::string throughput_text(std::span<const ScanReport> reports, const RunTime& time);

}  // namespace flagstone::app

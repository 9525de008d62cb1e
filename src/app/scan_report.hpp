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

/// Labels compared with a reference under one protocol.
struct Score {
  std::string protocol;
  eval::Confusion confusion;
};

/// How the sensor was taken to stand.
struct MountReport {
  Mount mount;             ///< what the scan was segmented with
  MountDecision decision;  ///< what was found out, by this scan or by the one that told the mount
};

/// What became of one scan.
struct ScanReport {
  std::filesystem::path file;
  std::optional<std::string> error;  ///< one line; the rest is not filled then

  std::size_t points = 0;
  std::array<std::size_t, label_count> counts{};
  std::size_t patches = 0;
  std::size_t file_size = 0;  ///< bytes read
  double read_ms = 0;
  double segment_ms = 0;
  double write_ms = 0;    ///< labels or clouds, without the picture
  double picture_ms = 0;  ///< 0 without a picture
  std::vector<Score> scores;
  std::optional<MountReport> mount;  ///< where it was to be found out
  bool mount_is_own = false;         ///< by this scan: the line for people says so
  std::vector<std::filesystem::path> outputs;

  [[nodiscard]] double ground_share() const noexcept;
};

/// What may be wrong if most points are out of range, and how to find out; empty otherwise.
std::string hint_of(const ScanReport& report);

/// One line for people.
std::string text_line(const ScanReport& report);

/// One JSON object, without line breaks.
std::string json_line(const ScanReport& report);

/// The last lines for people: how many scans, the median time, mean scores.
std::string summary_text(std::span<const ScanReport> reports);

/// How long a crew was at work, and how many they were.
struct CrewTime {
  double seconds = 0;
  std::size_t workers = 1;
};

/// A line for people: scans and megabytes (10^6 bytes) per second, what the workers spent their
/// time on, and which of files and segmenting takes more of it. "Other" is all that is neither:
/// pictures, scores, printing, waiting for one another. Failed scans do not count. Empty where none
/// is left.
std::string throughput_text(std::span<const ScanReport> reports, const CrewTime& time);

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/mapping/run_mapper.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// What a run has produced so far, in addition to the state of its RunMapper.
struct MapProgress {
  struct Scan {
    bool is_used = false;
    bool failed = false;
    Levelling levelling{};  ///< of finished scans
  };

  std::size_t next = 0;  ///< index of the first scan that is not mapped
  std::vector<Scan> scans;
  std::size_t moving_points = 0;
  std::string objects;  ///< lines of ObjectTable
  std::vector<std::string> problems;
};

/// Saves the state of a run from time to time, so that the run can be resumed after the process
/// was killed. A checkpoint is complete before it replaces the one before.
///
///     DIRECTORY/scans.json         MapProgress, and the number of the checkpoint
///     DIRECTORY/NUMBER/            the files of RunMapper::save()
class MapCheckpoints {
 public:
  /// `interval`: seconds of work between checkpoints; 0: after each scan.
  MapCheckpoints(std::filesystem::path directory, double interval)
      : directory_(std::move(directory)), interval_(interval) {}

  /// True if the interval has passed. It grows if saving takes long: at most 5 % of the time is
  /// used for it.
  [[nodiscard]] bool is_due() const;

  /// Writes a checkpoint; the directory must exist. If it fails, the one before stays. May throw
  /// std::bad_alloc and std::filesystem::filesystem_error.
  Status save(const MapProgress& progress, const RunMapper& mapper);

  /// Reads the last checkpoint. `mapper`: a new one with the same settings; `reread` as for
  /// RunMapper::load(). Returns nothing if no checkpoint exists, if it is damaged, or if it was
  /// written for another number of scans; `mapper` is then unspecified.
  std::optional<MapProgress> load(std::size_t scans, RunMapper& mapper,
                                  const RunMapper::Reread& reread);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] std::filesystem::path progress_file() const { return directory_ / "scans.json"; }
  [[nodiscard]] std::filesystem::path mapper_files(unsigned number) const {
    return directory_ / std::to_string(number);
  }

  std::filesystem::path directory_;
  double interval_;
  unsigned number_ = 0;  // of the last checkpoint, 0 or 1
  Clock::time_point saved_ = Clock::now();
  double duration_ = 0;  // of saving, seconds
};

}  // namespace flagstone::app

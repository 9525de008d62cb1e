// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/config/method_choice.hpp"
#include "app/mapping/run_mapper.hpp"
#include "app/run.hpp"
#include "app/segment_files.hpp"
#include "files/io/read_cloud.hpp"

namespace flagstone::app {

/// A run to map, and how.
struct MapRequest {
  std::filesystem::path run;    ///< directory with the scans, or with `velodyne/`
  std::filesystem::path poses;  ///< file of poses
  std::filesystem::path output;
  config::ResolvedMethod method;
  io::ReadOptions read{};
  LabelSource labels = LabelSource::offline;
  double delay = 2;              ///< for LabelSource::delayed, seconds
  std::optional<double> rate{};  ///< scans per second, if no file contains times
  bool heights = false;          ///< write heights above the ground
  double voxel = 0.2;            ///< of the static cloud, metres; 0: no cloud
  /// Memory of the map, megabytes; tiles beyond it are in files in the output directory. 0: no
  /// limit.
  std::size_t map_memory = 1000;
  unsigned threads = 0;  ///< 0: all cores; the output does not depend on it
  bool picture = true;   ///< draw the ground
  /// Seconds of work between checkpoints, from which an interrupted run is resumed; 0: after each
  /// scan. The output does not depend on it.
  double checkpoint_interval = 60;
  std::vector<std::filesystem::path> settings_files{};  ///< must not be overwritten
};

/// Scans per second if nothing is known about times.
inline constexpr double default_rate = 10;

struct MapCallbacks {
  RunCallbacks run{};
  std::function<void(const FoundMount&)> mount{};  ///< before the first scan
};

/// Result of map_run().
struct MapOutcome {
  std::size_t scans = 0;
  std::size_t mapped = 0;  ///< scans that are part of the map
  std::size_t alone = 0;   ///< scans without a usable pose, labelled alone
  std::size_t failed = 0;  ///< scans that could not be read or segmented
  std::size_t moving_points = 0;
  std::size_t static_points = 0;  ///< of the static cloud
  double path = 0;                ///< metres travelled by the mapped scans
  double area = 0;                ///< of the map, square metres
  std::size_t map_bytes = 0, vote_bytes = 0;
  double seconds = 0;
  bool interrupted = false;
  std::vector<std::string> problems{};  ///< as in run.json
};

/// Checks everything in a request that does not depend on files. Throws std::invalid_argument.
void check_map_request(const MapRequest& request);

/// Maps a run and writes the files of MapOutputs.
///
/// Poses are checked (see check_poses()): a scan without a usable pose, or whose ground does not
/// fit the map, is labelled alone. If the run falls into parts whose poses do not fit together, the
/// longest part is mapped. A scan that cannot be read or segmented is reported in one line and has
/// no labels. The same call again resumes an interrupted one from its last checkpoint, and the
/// files are identical. A stopped run writes a checkpoint. Throws std::invalid_argument, before
/// anything is written, if the request is invalid, an output would overwrite an input, or the
/// output directory contains other files than MapOutputs::input(); std::runtime_error if a file
/// cannot be read or written.
MapOutcome map_run(MapRequest request, const MapCallbacks& callbacks);

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/scan_files.hpp"
#include "files/io/pose_file.hpp"
#include "flagstone/ground_map.hpp"

namespace flagstone::app {

/// Where the sensor was at one scan. A scan without a pose is segmented alone.
struct ScanPose {
  std::optional<Pose> pose{};    ///< of the sensor; not checked, see check_poses()
  std::optional<double> time{};  ///< of the scan, seconds; nothing if unknown
  std::string reason{};          ///< why the pose is missing, in a few words
};

/// The poses of the scans of a run.
struct RunPoses {
  std::vector<ScanPose> scans;     ///< one per scan, in their order
  std::vector<std::string> notes;  ///< one line each: decisions, and scans without a pose
  io::PoseFormat format = io::PoseFormat::kitti;
  /// The calibration that was applied to poses of a camera; empty if none was.
  std::filesystem::path calibration;

  /// The times of the scans, NaN if unknown; empty if no time is known.
  [[nodiscard]] std::vector<double> times() const;
};

/// Largest distance between two poses that are interpolated, seconds.
inline constexpr double max_pose_gap = 0.15;

/// Times closer than this are the same, seconds: files round them differently.
inline constexpr double same_time = 1e-3;

/// Pairs poses with scans. Never extrapolates.
///
/// If both poses and scans have times, a scan gets the pose of its time, interpolated between the
/// valid poses before and after it if these are at most max_pose_gap apart. Otherwise poses belong
/// to scans in their order. If their numbers differ and the names of all scans are numbers that
/// could count lines, as in KITTI, scan N belongs to line N from 0.
///
/// `scans`: sorted. `scan_times`: seconds, in the order of the scans or of their numbers; empty if
/// unknown.
RunPoses pair_poses(const io::PoseFile& poses, std::span<const ScanInput> scans,
                    std::span<const double> scan_times);

/// Reads the poses of a run and pairs them with its scans.
///
/// `run`: the directory with the scans, or the one above. It can contain `times.txt` or
/// `timestamps.txt` with the time of each scan. If the poses are in KITTI format and `calib.txt` is
/// next to them or in the run, they are poses of the camera and are converted to the sensor.
/// Throws std::runtime_error with one line if a file cannot be read.
RunPoses read_run_poses(const std::filesystem::path& run, std::span<const ScanInput> scans,
                        const std::filesystem::path& poses);

}  // namespace flagstone::app

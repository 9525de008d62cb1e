// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/status.hpp"

namespace flagstone::io {

/// Formats of files of poses.
enum class PoseFormat {
  kitti,  ///< 12 numbers per line: the rows of a 3x4 matrix
  tum,    ///< time x y z qx qy qz qw, separated by blanks
  csv,    ///< a header that names the columns, separated by commas or semicolons
};

/// Why a line contains no pose.
enum class PoseFault {
  none,
  not_finite,      ///< a number is NaN or infinite
  not_a_rotation,  ///< quaternion not of unit length within 1 %, or matrix off by more than 1e-3
  too_far,         ///< a coordinate beyond 10,000 km
};

/// A few words for a message: "is not finite".
std::string_view to_text(PoseFault fault) noexcept;

/// One line of a file of poses.
struct PoseLine {
  std::size_t number = 0;        ///< of the line in the file, from 1
  std::optional<double> time{};  ///< seconds, finite; nothing if the line contains none
  std::optional<Pose> pose{};    ///< its rotation is exact; nothing if there is a fault
  PoseFault fault = PoseFault::none;
};

/// The poses of a run in the order of their file.
struct PoseFile {
  PoseFormat format = PoseFormat::kitti;
  bool has_times = false;  ///< the lines contain times, unless a time is not finite
  std::vector<PoseLine> poses;
};

/// Most poses in one file.
inline constexpr std::size_t max_poses = 10'000'000;

/// Reads a file of poses; its content determines the format, not its name.
///
/// KITTI: 12 numbers per line. TUM: 8 numbers per line. CSV: a header, which may begin with `#` or
/// `%`, names the columns of the time (seconds; other units by a suffix such as `[ns]` or `_ns`, or
/// by their size), of x, y, z, and of a quaternion or of roll, pitch and yaw (radians, R = Rz(yaw)
/// Ry(pitch) Rx(roll)). Names of exporters of ROS and of EuRoC are accepted; other columns are
/// ignored. Empty lines and lines that begin with `#` are skipped. Small errors of rotations are
/// removed.
///
/// A line with numbers that are not a pose is one bad pose; a line of another form is an error of
/// the file: not_found, unreadable, bad_file with `PATH: line N: PROBLEM`, out_of_memory. Never
/// throws; changes `out` only on success.
Status read_poses(const std::filesystem::path& path, PoseFile& out);

/// As read_poses(), for text in memory; the message has no path.
Status parse_poses(std::string_view text, PoseFile& out);

/// Reads the transform from the sensor to the camera of a KITTI calib.txt: the line `Tr:` or
/// `Tr_velo_to_cam:`. bad_file if the line is missing or is not a rotation with a translation.
/// Other errors as read_poses().
Status read_sensor_to_camera(const std::filesystem::path& path, Pose& out);

/// As read_sensor_to_camera(), for text in memory; the message has no path.
Status parse_sensor_to_camera(std::string_view text, Pose& out);

/// Converts poses of the camera to poses of the sensor, in place: inv(Tr) * pose * Tr.
void convert_from_camera(const Pose& sensor_to_camera, std::vector<PoseLine>& poses) noexcept;

/// Reads a file with one time in seconds per line, as times.txt of KITTI. Times that are not finite
/// are NaN. Errors as read_poses().
Status read_times(const std::filesystem::path& path, std::vector<double>& out);

/// As read_times(), for text in memory; the message has no path.
Status parse_times(std::string_view text, std::vector<double>& out);

}  // namespace flagstone::io

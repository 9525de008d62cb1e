// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "app/pose_checks.hpp"
#include "cloud_properties.hpp"
#include "files/io/pose_file.hpp"
#include "library/ground_map/poses.hpp"
#include "text_properties.hpp"

// Any text as a file of poses, of times, and as a calibration. Poses that are read are rotations,
// each other line has a fault, and the checks accept every run.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<double> times;
  const Status read_times = io::parse_times(text, times);
  if (!read_times.ok()) fuzz::check_line(read_times.message());
  Pose to_camera;
  const Status read_calibration = io::parse_sensor_to_camera(text, to_camera);
  if (!read_calibration.ok()) fuzz::check_line(read_calibration.message());
  fuzz::require(is_valid(to_camera), "a calibration is a rotation and a translation");

  io::PoseFile file;
  const Status status = io::parse_poses(text, file);
  if (!status.ok()) {
    fuzz::check_line(status.message());
    return 0;
  }
  fuzz::require(file.poses.size() <= size, "a pose is at least one character");
  std::vector<std::optional<Pose>> poses;
  times.clear();
  for (const io::PoseLine& line : file.poses) {
    fuzz::require(!line.pose || is_valid(*line.pose), "a pose is a rotation and a position");
    fuzz::require(line.pose.has_value() == (line.fault == io::PoseFault::none),
                  "a line has either a pose or a fault");
    poses.push_back(line.pose);
    times.push_back(line.time.value_or(std::nan("")));
  }
  for (const bool has_times : {true, false}) {
    const app::PoseChecks checks = app::check_poses(
        poses, has_times ? std::span<const double>(times) : std::span<const double>());
    fuzz::require(checks.scans.size() == poses.size(), "each scan is checked");
    for (std::size_t scan = 0; scan < poses.size(); ++scan) {
      fuzz::require(!checks.scans[scan].usable || poses[scan].has_value(), "no pose is not usable");
      fuzz::require(!checks.scans[scan].usable || checks.scans[scan].part < checks.parts,
                    "parts are numbered from 0");
    }
    for (const app::PoseProblem& problem : checks.problems) {
      fuzz::check_line(problem.message);
      fuzz::require(problem.first <= problem.last && problem.last < poses.size(),
                    "a problem names scans of the run");
    }
  }
  return 0;
}

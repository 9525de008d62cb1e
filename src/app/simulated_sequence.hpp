// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/scan.hpp"

namespace flagstone::app {

/// Everything that determines the bytes of a simulated sequence.
struct SequenceOrigin {
  std::string scene;
  Sensor sensor;
  sim::Mounting mounting;
  std::string noise_name;            ///< of a sim::NoiseLevel
  std::vector<std::string> weather;  ///< names of sim::Weather; all apply together
  sim::Noise noise;                  ///< result of noise level and weather
  bool keep_no_returns = false;
  sim::Pace pace;
  sim::Extent extent;
  std::string pose_noise = "none";  ///< of a sim::PoseNoise
  std::uint64_t seed = 0;
  std::size_t frames = 0;
};

/// The files of a simulated sequence, in the layout of SemanticKITTI: velodyne/NNNNNN.bin,
/// labels/NNNNNN.label, poses.txt, times.txt and calib.txt. In addition: ground/NNNNNN.ground.npy,
/// the true ground height at each point; returns/NNNNNN.return.npy, the kind of each return;
/// motion/NNNNNN.motion.npy, the motion of the object at each point; with motion distortion,
/// times/NNNNNN.time.npy, the time of each point; and scene.json, the SequenceOrigin. Files are
/// written atomically. Errors throw std::runtime_error.
class SimulatedSequence {
 public:
  /// `timed`: each scan has a file of times.
  SimulatedSequence(std::filesystem::path folder, bool timed)
      : folder_(std::move(folder)), timed_(timed) {}

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Creates the directories and writes scene.json and calib.txt. Throws std::invalid_argument if
  /// the directory contains other data, or more frames than `origin` has.
  void begin(const SequenceOrigin& origin) const;

  /// True if scan, labels, ground, returns, motion and times exist and their sizes match.
  [[nodiscard]] bool has(std::size_t frame) const;

  /// `ground`: sim::true_ground() of the scan; `times`: of its points, seconds.
  void write(std::size_t frame, const sim::SimulatedScan& scan, std::span<const float> ground,
             std::span<const float> times) const;

  /// Writes a file of poses: per frame one line with the rows of the 3x4 matrix from the sensor to
  /// its environment.
  void write_poses(const char* name, std::span<const sim::Frame> poses) const;

  /// Writes times.txt: per frame one line with the time of its pose in seconds, from 0.
  void write_times(std::size_t frames, double rate) const;

 private:
  [[nodiscard]] std::filesystem::path scan_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path label_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path ground_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path return_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path motion_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path time_file(std::size_t frame) const;
  void refuse_others(const SequenceOrigin& origin) const;

  std::filesystem::path folder_;
  bool timed_;
};

}  // namespace flagstone::app

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
#include "lab/sim/geometry.hpp"
#include "lab/sim/scan.hpp"

namespace flagstone::app {

/// What a simulated sequence is made from; the same gives the same bytes.
struct SequenceOrigin {
  std::string scene;
  Sensor sensor;
  sim::Mounting mounting;
  std::string noise_name;            ///< of a sim::NoiseLevel
  std::vector<std::string> weather;  ///< names of sim::Weather, all of them at once
  sim::Noise noise;                  ///< what both make
  bool keep_no_returns = false;
  std::uint64_t seed = 0;
  std::size_t frames = 0;
};

/// The files of a simulated sequence, laid out as SemanticKITTI's: velodyne/NNNNNN.bin,
/// labels/NNNNNN.label, poses.txt, calib.txt, beside them ground/NNNNNN.ground.npy, the true height
/// of the ground at each point, returns/NNNNNN.return.npy, what each is a return of, and
/// scene.json, which says what the sequence was made from. Every file is there whole or not at all.
/// What fails throws std::runtime_error.
class SimulatedSequence {
 public:
  explicit SimulatedSequence(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Makes the folders and writes scene.json and calib.txt. Throws std::invalid_argument where the
  /// folder already holds something else, or more frames than `origin` has.
  void begin(const SequenceOrigin& origin) const;

  /// Are the scan, its labels, its ground and its returns there, of sizes that fit each other?
  [[nodiscard]] bool has(std::size_t frame) const;

  /// `ground` is what sim::true_ground() gives for the scan.
  void write(std::size_t frame, const sim::SimulatedScan& scan,
             std::span<const float> ground) const;

  /// poses.txt: a line a frame, the rows of the 3x4 matrix from the sensor to the world of its
  /// drive.
  void write_poses(std::span<const sim::Frame> poses) const;

 private:
  [[nodiscard]] std::filesystem::path scan_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path label_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path ground_file(std::size_t frame) const;
  [[nodiscard]] std::filesystem::path return_file(std::size_t frame) const;
  void refuse_others(const SequenceOrigin& origin) const;

  std::filesystem::path folder_;
};

}  // namespace flagstone::app

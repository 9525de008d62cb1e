// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/run.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/extent.hpp"

namespace flagstone::app {

/// @name Limits of SimulateOptions
/// @{
inline constexpr std::size_t max_frames = 100000;
inline constexpr double max_simulated_height = 100;       ///< metres
inline constexpr double max_simulated_tilt = 90;          ///< degrees
inline constexpr double min_rate = 0.1, max_rate = 100;   ///< scans per second
inline constexpr double min_speed = 0.1, max_speed = 30;  ///< m/s
inline constexpr double max_length = 20000;               ///< metres
/// @}

struct SimulateOptions {
  std::string output;                     ///< directory for sequences/NN
  std::string scene;                      ///< name of a sim::SceneKind
  std::string sensor = "hdl-64e";         ///< name or .toml file
  std::optional<double> sensor_height{};  ///< metres above the ground; none: the sensor's usual one
  std::string tilt = "0,0";               ///< pitch and roll, degrees
  std::string noise = "default";          ///< name of a sim::NoiseLevel
  std::vector<std::string> weather{"clear"};  ///< names of sim::Weather
  bool keep_no_returns = false;               ///< write missing returns as points at (0, 0, 0)
  std::size_t frames = 200;                   ///< 1 to max_frames
  double length = sim::stretch_length;        ///< of an environment, metres; up to max_length
  bool loop = false;                          ///< a circuit of this length, passed twice
  sim::Pace pace;                   ///< rate, speed and distortion, within the limits above
  std::string pose_noise = "none";  ///< name of a sim::PoseNoise
  std::uint64_t seed = 1;
  std::string sequence = "00";  ///< two digits
  unsigned threads = 0;         ///< 0: all cores
};

/// Outcome of a simulation.
struct Simulation {
  std::filesystem::path folder;  ///< OUTPUT/sequences/NN
  std::string sensor;            ///< name
  std::size_t drives = 0;        ///< environments
  std::size_t frames_per_environment = 0;
  std::size_t simulated = 0;  ///< frames
  std::size_t kept = 0;       ///< frames that already existed
  bool interrupted = false;   ///< a message reports it; the same call resumes
};

/// Writes a sequence of simulated scans with exact ground truth, see SimulatedSequence. Frames that
/// already exist are kept. The output does not depend on the number of threads. Throws
/// std::invalid_argument, one line, if an option is invalid or the directory contains other data,
/// and std::runtime_error if a file cannot be written.
Simulation simulate(const SimulateOptions& options, const RunCallbacks& callbacks);

}  // namespace flagstone::app

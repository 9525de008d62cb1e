// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/moving_points.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// The files of a mapped run.
struct MapOutputs {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path description() const { return directory / "run.json"; }
  [[nodiscard]] std::filesystem::path poses() const { return directory / "poses.txt"; }
  [[nodiscard]] std::filesystem::path objects() const { return directory / "objects.csv"; }
  [[nodiscard]] std::filesystem::path ground() const { return directory / "ground"; }
  [[nodiscard]] std::filesystem::path picture() const { return directory / "ground.png"; }
  [[nodiscard]] std::filesystem::path static_cloud() const { return directory / "static.ply"; }
  /// Scans and poses of a bag, or poses that KISS-ICP found. Written before the run is mapped, by
  /// the Python package, and not changed by map_run().
  [[nodiscard]] std::filesystem::path input() const { return directory / "input"; }
  [[nodiscard]] std::filesystem::path input_poses() const { return input() / "poses.txt"; }
  /// Checkpoints, until the run is finished; see MapCheckpoints.
  [[nodiscard]] std::filesystem::path state() const { return directory / "state"; }
  /// @name Files per scan
  /// @{
  [[nodiscard]] std::filesystem::path labels(const std::string& name) const {
    return directory / "labels" / (name + ".label");
  }
  [[nodiscard]] std::filesystem::path moving(const std::string& name) const {
    return directory / "moving" / (name + ".moving.npy");
  }
  [[nodiscard]] std::filesystem::path heights(const std::string& name) const {
    return directory / "heights" / (name + ".heights.npy");
  }
  /// @}
};

/// Writes the number of the moving object of each point (0: none) as an array of uint16; objects
/// beyond 65,535 have that number. Written atomically. unwritable, out_of_memory.
Status write_moving(const std::filesystem::path& path, const MovingMask& moving);

/// Reads such an array. Errors as io::read_reference(): also another number of points.
Status read_moving(const std::filesystem::path& path, std::size_t points, MovingMask& moving);

/// The moving objects of a run, as lines of a CSV file with a header.
class ObjectTable {
 public:
  void add(const std::string& scan, std::span<const MovingObject> objects);

  /// The lines so far, to continue later.
  [[nodiscard]] const std::string& lines() const noexcept { return lines_; }
  void set_lines(std::string lines) noexcept { lines_ = std::move(lines); }

  /// Written atomically.
  [[nodiscard]] Status write(const std::filesystem::path& path) const;

 private:
  std::string lines_;
};

/// The pose after levelling: moved to the height of the map, and rotated by its slope.
Pose levelled(const Pose& pose, const Levelling& levelling) noexcept;

/// Writes poses in KITTI format, one line per scan. Written atomically.
Status write_kitti_poses(const std::filesystem::path& path, std::span<const Pose> poses);

}  // namespace flagstone::app

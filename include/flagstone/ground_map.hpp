// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"

namespace flagstone {

struct MeasuredHeight;

/// Pose of a sensor in the world frame: a point p of the scan is at rotation * p + position.
struct Pose {
  /// Rotation matrix, row by row. Its columns are the axes of the sensor in the world frame.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> position{};  ///< of the sensor, metres
};

/// Settings of a GroundMap.
struct GroundMapConfig {
  /// Size of a cell, metres, 0.1 to 2.
  double cell = 0.5;
  /// Points farther from the sensor than this are not added, metres, 5 to 100.
  double max_range = 40;
  /// After each scan, tiles farther from the sensor than this are removed, metres, 50 to 1e6.
  /// 0: the map keeps everything.
  double window = 0;
  /// Largest height difference between a scan and the map that is treated as an error of the pose,
  /// metres, 0 to 100, beyond the correction of the scan before. Scans that differ more are added
  /// with the correction of the scan before.
  double max_correction = 1;
  /// Largest memory of the cells, bytes. Beyond it, the tiles that were not measured for the
  /// longest time are moved to the TileStore of the map. 0: no limit. Not together with `window`.
  std::size_t max_memory = 0;

  /// Throws std::invalid_argument if a value is out of its range.
  void check() const;
};

/// The correction of a pose in height, pitch and roll that fits a scan to the map.
struct Levelling {
  /// False: too few common cells, or a difference above max_correction. The plane is then the
  /// plane of the scan before.
  bool applied = false;
  std::size_t cells = 0;  ///< number of cells that both the scan and the map know
  /// @name Plane to subtract from heights in the world frame
  /// offset + slope_x (x - X) + slope_y (y - Y), where (X, Y) is the position of the sensor.
  /// @{
  double offset = 0;   ///< metres
  double slope_x = 0;  ///< m/m
  double slope_y = 0;  ///< m/m
  /// @}

  /// The correction at (x, y), metres, for a sensor at `position`.
  [[nodiscard]] double at(double x, double y,
                          const std::array<double, 3>& position) const noexcept {
    return offset + slope_x * (x - position[0]) + slope_y * (y - position[1]);
  }
};

/// The ground of a map at one position.
struct MapSample {
  double height = 0;              ///< z of the ground, metres, world frame; NaN if unknown
  std::array<float, 3> normal{};  ///< unit length, z > 0; NaN if unknown
  float slope = 0;  ///< angle between normal and z axis, radians, 0 to pi/2; NaN if unknown
  /// Expected error of the height, metres; NaN if unknown. In simulated runs, 72 to 99 % of the
  /// cells were within it and 86 to 99.9 % within twice of it, depending on scene and sensor.
  /// Errors have more outliers than a normal distribution.
  float deviation = 0;
  std::uint32_t scans = 0;           ///< scans that agree on the height of the nearest cell
  std::uint32_t contradictions = 0;  ///< scans that measured another height in that cell
  std::uint32_t age = 0;             ///< scans added since the nearest cell was measured last
};

/// Index of a tile of a GroundMap: a square of tile_width x tile_width cells. With w = tile_width
/// times the size of a cell, the tile covers x from w * index.x to w * (index.x + 1), and y in
/// the same way.
struct TileIndex {
  std::int64_t x = 0;  ///< column of tiles
  std::int64_t y = 0;  ///< row of tiles

  /// True if both are equal.
  friend bool operator==(TileIndex, TileIndex) = default;
};

/// The cells of a tile, row by row: the first row has the smallest y, the first cell of a row the
/// smallest x. MapSample has the meaning of the values.
struct MapTile {
  static constexpr std::size_t cells = 4096;  ///< number of cells

  std::array<float, cells> height;         ///< z of the ground, metres, world frame; NaN if unknown
  std::array<float, cells> deviation;      ///< expected error of the height, metres; NaN if unknown
  std::array<std::uint16_t, cells> scans;  ///< scans that agree on the height
  std::array<std::uint16_t, cells> contradictions;  ///< scans that measured another height
  /// Number of the scan that measured the cell last, at least 1; 0: none.
  std::array<std::uint32_t, cells> last_scan;
};

/// Storage of a GroundMap for the tiles beyond its memory limit, such as a directory. A map calls
/// one function at a time.
class TileStore {
 public:
  virtual ~TileStore() = default;

  /// Stores the bytes of a tile. They replace those that it had before.
  virtual Status put(TileIndex index, std::span<const std::byte> bytes) = 0;

  /// Reads the bytes that were stored for a tile last. May throw std::bad_alloc.
  virtual Status get(TileIndex index, std::vector<std::byte>& bytes) const = 0;

 protected:
  TileStore() = default;
  TileStore(const TileStore&) = default;
  TileStore& operator=(const TileStore&) = default;
};

/// The ground along a run, in the world frame: one height per cell, from all scans that saw the
/// cell. Each scan is levelled to the map before it is added, which removes the errors of its pose
/// in height, pitch and roll. Over long distances, about 100 m, the map follows the
/// poses.
///
/// If a run returns to the same ground, or a second run passes it, the first pass decides: later
/// scans are levelled to its heights. If a scan differs from the map by more than
/// GroundMapConfig::max_correction, it is not levelled, because it may be another
/// storey. A cell keeps two heights, so a wrong one from one scan, such as a car roof, gives way to
/// the height with more evidence. MapSample::contradictions counts the scans of the other height.
///
/// The map does not depend on the order of the points in a scan, nor on threads; it depends on the
/// order of the scans. Not thread-safe while a scan is added; otherwise several threads can read
/// it.
class GroundMap {
 public:
  /// Cells along one side of a tile.
  static constexpr std::int64_t tile_width = 64;

  /// Throws std::invalid_argument if the configuration is invalid.
  explicit GroundMap(const GroundMapConfig& config = {});
  /// A map with a memory limit, `config.max_memory`, that puts other tiles into `store`. The
  /// limit does not change any result. Throws std::invalid_argument if only one of them
  /// is given.
  GroundMap(const GroundMapConfig& config, std::shared_ptr<TileStore> store);
  ~GroundMap();
  GroundMap(GroundMap&&) noexcept;
  GroundMap& operator=(GroundMap&&) noexcept;

  /// The configuration.
  [[nodiscard]] const GroundMapConfig& config() const noexcept;

  /// Fits a scan to the map without adding it.
  ///
  /// `result` is the segmentation of `cloud` by a method with a ground surface. The z axis of the
  /// cloud should point up within about 30 degrees. invalid_argument if the sizes differ, the
  /// result has no heights, or the pose is not finite or not a rotation; out_of_memory. Never
  /// throws.
  Status level(CloudView cloud, const Segmentation& result, const Pose& pose, Levelling& levelling);

  /// Fits a scan to the map, adds it and returns how it was fitted. Errors as level(), and those of
  /// the store; after them the map is as before. Only if the store fails to write, the scan has
  /// been added, and the tiles stay in memory.
  Status add(CloudView cloud, const Segmentation& result, const Pose& pose, Levelling& levelling);

  /// Adds the scan that level() fitted last: the same as add() for that scan, in less time.
  /// invalid_argument if level() failed, or the map changed after it; out_of_memory and the errors
  /// of the store as for add(). Never throws.
  Status add_levelled();

  /// The ground at (x, y), world frame, metres: interpolated between the four nearest cells, if
  /// those that are known have more than half of the weight. Any value is allowed.
  [[nodiscard]] MapSample at(double x, double y) const noexcept;

  /// Same as at(x, y).height, but faster.
  [[nodiscard]] double height(double x, double y) const noexcept;

  /// Writes the height of each point of a scan above the ground, metres: the mean of its height
  /// above the surface of the scan and its height above the map, weighted by their expected errors.
  /// In cells in which the scan has points on the ground, this is nearly its own height. In other
  /// cells, it is the height above the map. If one of them is unknown, it is the other one. NaN if
  /// both are unknown, and for points that are invalid or out of range. `levelling`: as add() or
  /// level() returned it for the scan. Errors as level(), and invalid_argument if `heights` has
  /// another size than the cloud. Never throws.
  Status heights(CloudView cloud, const Segmentation& result, const Pose& pose,
                 const Levelling& levelling, std::span<float> heights) const;

  /// Changes labels `ground` of a scan to `nonground` where a point is too far above the map. Far
  /// away, a scan has few points on the ground, and its surface can follow the points on objects;
  /// the map has the ground from nearer scans. The margin is the default PointRule::margin, or
  /// PointRule::obstacle_margin in cells that contain an obstacle in this scan, plus the expected
  /// error of the map, at most 0.06 m. If the map is unknown at a point, its label stays.
  /// `levelling`: as for heights(). Errors as level(), and invalid_argument if `labels` has another
  /// size than the cloud. Never throws.
  Status relabel(CloudView cloud, const Segmentation& result, const Pose& pose,
                 const Levelling& levelling, std::span<Label> labels) const;

  /// The tiles with a height, sorted by y, then by x. May throw std::bad_alloc.
  [[nodiscard]] std::vector<TileIndex> tiles() const;

  /// Copies a tile. False if it has no height or the store fails to read it; `tile` is then
  /// unchanged.
  bool read_tile(TileIndex index, MapTile& tile) const noexcept;

  /// The state of the map as bytes, which from_bytes() reads on any machine: scans that are added
  /// later give the same results as without the break. Does not contain settings other than the
  /// size of a cell. The errors of the store, out_of_memory; `bytes` is then empty. Never throws.
  Status to_bytes(std::vector<std::byte>& bytes) const;

  /// Replaces the state of the map. The bytes are checked, so they may come from anywhere: bad_file
  /// with the offset if they are damaged, of another version or of a map with other cells;
  /// out_of_memory; the map is then as before. The errors of the store. Never throws.
  Status from_bytes(std::span<const std::byte> bytes);

  /// Number of scans added.
  [[nodiscard]] std::size_t scans() const noexcept;

  /// Number of cells with a height.
  [[nodiscard]] std::size_t cells() const noexcept;

  /// Memory in use, bytes.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  class Tiles;
  class Builder;

  Status fit(CloudView cloud, const Segmentation& result, const Pose& pose, Levelling& levelling);
  Status add_fitted();

  std::unique_ptr<Tiles> tiles_;
  std::unique_ptr<Builder> builder_;
};

}  // namespace flagstone

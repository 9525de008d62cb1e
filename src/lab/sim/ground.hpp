// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lab/sim/cross_lines.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

class Alignment;

/// The lines of a ground grid. Grid point (i, j) is at x[i], offset[i] + t[j]. Lines across the
/// road are straight; lines along it bend together, so that kerbs and markings of a winding road
/// can follow grid lines.
struct GroundGrid {
  std::vector<double> x;       ///< ascending, metres; at least 2
  std::vector<double> offset;  ///< y of t = 0, one per x, metres
  std::vector<double> t;       ///< ascending, metres; at least 2
  bool closed = false;         ///< the last x is the first one again: the ground repeats along x
};

/// The ground: one height and one surface at every position. The mesh for ray casting and the
/// height functions use the same triangles, so the ground truth is exact.
class Ground {
 public:
  /// `heights[i * t.size() + j]` is the height of grid point (i, j), metres.
  /// `surfaces[i * (t.size() - 1) + j]` is the surface of the cell between grid points (i, j) and
  /// (i + 1, j + 1). Throws std::invalid_argument if the sizes do not match or lines do not ascend.
  Ground(GroundGrid grid, std::vector<double> heights, std::vector<Surface> surfaces);

  /// Height at (x, y), metres, world frame. Beyond the grid, the plane of the nearest edge cell is
  /// extended.
  [[nodiscard]] double height(double x, double y) const noexcept;

  /// Surface at (x, y).
  [[nodiscard]] const Surface& surface(double x, double y) const noexcept;

  /// Whether the grid covers (x, y).
  [[nodiscard]] bool covers(double x, double y) const noexcept;

  /// Distance along the ray from `origin` to the first intersection with the ground, in lengths of
  /// `direction`. Exact except for rounding; 0 on the ground itself. Nothing if the ray starts
  /// outside the grid or leaves it first.
  [[nodiscard]] std::optional<double> first_crossing(Vector3 origin,
                                                     Vector3 direction) const noexcept;

  /// This ground, in road coordinates, along a line in the world frame. All heights remain exact:
  /// its corners are moved, and the triangles between them are flat. It covers at most
  /// alignment_half_width on either side of the line.
  [[nodiscard]] Ground along(const Alignment& line) const;

  /// Adds the triangles of the ground.
  void add_to(Mesh& mesh) const { add_to(mesh, {grid_.x.front(), grid_.x.back()}); }

  /// Adds the triangles of the cells that begin in this part of the x axis of the grid.
  void add_to(Mesh& mesh, Interval x) const;

 private:
  struct Place {
    std::size_t i, j;  // cell
    double u, v;       // 0..1 along x and t within the cell
  };
  struct Along;
  struct CellPlace;
  [[nodiscard]] Place place(double x, double y) const noexcept;
  [[nodiscard]] Place place_on_bend(double x, double y) const noexcept;
  [[nodiscard]] CellPlace along_straight(std::size_t i, std::size_t j, const Along& x,
                                         const Along& y) const noexcept;
  [[nodiscard]] CellPlace along_bend(std::size_t i, std::size_t j, bool is_lower, const Along& x,
                                     const Along& y) const noexcept;
  [[nodiscard]] double grid_height(std::size_t i, std::size_t j) const noexcept {
    return heights_[i * grid_.t.size() + j];
  }

  GroundGrid grid_;
  CrossLines bend_;  // one per x; empty if the lines across are along y
  std::vector<double> heights_;
  std::vector<Surface> surfaces_;
};

/// The frame of a car on its wheels at (x, y), with its origin on the ground. It is tilted like the
/// ground between points `length` metres apart along the car and `width` metres across.
Frame frame_on_wheels(const Ground& ground, double x, double y, double yaw, double length,
                      double width);

/// Adds lines from `begin` to `end` inclusive, evenly spaced, at most `step` apart.
void add_lines(std::vector<double>& lines, double begin, double end, double step);

/// Sorts the lines and removes those that differ from another line only by rounding.
void finish_lines(std::vector<double>& lines);

/// A ground defined by functions, and the grid lines at which they are sampled. Metres; t is
/// measured to the left of a line that runs along x.
struct GroundPlan {
  std::vector<double> x, t;                            ///< ascending, see finish_lines()
  std::function<double(double x)> offset;              ///< y of t = 0
  std::function<double(double x, double t)> height;    ///< at the intersections of the lines
  std::function<Surface(double x, double t)> surface;  ///< in the middle of every cell
  bool closed = false;                                 ///< see GroundGrid
};

/// Converts the plan to triangles.
Ground cut_ground(GroundPlan plan);

/// The true z of the ground at each point of a scan, metres: the point is z - ground metres above
/// the ground along `up`, the z axis of the vehicle in the world frame, of length 1. For a sensor
/// that is mounted upright, this is the z of the ground on the line through the point along the z
/// axis of the sensor. `xyzi` contains 4 floats per point, as in SimulatedScan.
///
/// The line is tilted with the vehicle and may meet a steep face more than once. The first ground
/// counts: downwards from a point above the ground, upwards from a point below. NaN if the ground
/// does not cover the point or the line, and for (0, 0, 0), which is a missing return.
std::vector<float> true_ground(const Ground& ground, const Frame& pose, Vector3 up,
                               std::span<const float> xyzi);

/// As above, for one point of a scan.
float true_ground(const Ground& ground, const Frame& pose, Vector3 up, const float* xyz);

/// As above, for a sensor that is mounted upright.
std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi);

}  // namespace flagstone::sim

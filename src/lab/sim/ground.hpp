// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// The lines of a ground grid. Grid point (i, j) lies at x[i], offset[i] + t[j]: the lines across
/// are straight, those along bend together, so that kerbs and markings can lie on grid lines of a
/// winding road.
struct GroundGrid {
  std::vector<double> x;       ///< ascending, metres; at least 2
  std::vector<double> offset;  ///< y of t = 0, one per x, metres
  std::vector<double> t;       ///< ascending, metres; at least 2
};

/// The ground: one height and one surface for every place. It is the single truth: the mesh that
/// beams are cast against and the height that anything asks for are the same triangles.
class Ground {
 public:
  /// `heights[i * t.size() + j]` is the height of grid point (i, j), metres;
  /// `surfaces[i * (t.size() - 1) + j]` is what lies between grid points (i, j) and (i + 1, j + 1).
  /// Throws std::invalid_argument if sizes do not fit or lines do not ascend.
  Ground(GroundGrid grid, std::vector<double> heights, std::vector<Surface> surfaces);

  /// Height at a place, metres, world frame; beyond the grid that of the nearest edge cell's plane.
  [[nodiscard]] double height(double x, double y) const noexcept;

  /// What the ground is made of at a place.
  [[nodiscard]] const Surface& surface(double x, double y) const noexcept;

  /// Does the grid cover the place?
  [[nodiscard]] bool covers(double x, double y) const noexcept;

  /// How far along the ray from `origin` the ground is met first, in lengths of `direction`: exact
  /// but for rounding, 0 on the ground itself. Nothing where the ray begins off the grid or leaves
  /// it before.
  [[nodiscard]] std::optional<double> first_crossing(Vector3 origin,
                                                     Vector3 direction) const noexcept;

  /// Adds the ground's triangles.
  void add_to(Mesh& mesh) const;

 private:
  struct Place {
    std::size_t i, j;  // cell
    double u, v;       // 0..1 along x and t within the cell
  };
  [[nodiscard]] Place place(double x, double y) const noexcept;
  [[nodiscard]] double grid_height(std::size_t i, std::size_t j) const noexcept {
    return heights_[i * grid_.t.size() + j];
  }

  GroundGrid grid_;
  std::vector<double> heights_;
  std::vector<Surface> surfaces_;
};

/// Standing on the ground at (x, y) as a car stands on its wheels: tilted like the ground between
/// points `length` metres apart along and `width` metres across, origin on the ground.
Frame frame_on_wheels(const Ground& ground, double x, double y, double yaw, double length,
                      double width);

/// Adds lines from `begin` to `end` inclusive, evenly spaced, at most `step` apart.
void add_lines(std::vector<double>& lines, double begin, double end, double step);

/// Sorts, and drops lines that are so near to another one that only rounding tells them apart.
void finish_lines(std::vector<double>& lines);

/// A ground as formulas, and the lines at which they are taken. Metres; t is measured to the left
/// of a line that runs along x.
struct GroundPlan {
  std::vector<double> x, t;                            ///< ascending, see finish_lines()
  std::function<double(double x)> offset;              ///< y of t = 0
  std::function<double(double x, double t)> height;    ///< at the crossings of the lines
  std::function<Surface(double x, double t)> surface;  ///< in the middle of every cell
};

/// The plan as triangles.
Ground cut_ground(GroundPlan plan);

/// Where the ground truly is at each point of a scan, so that the point stands z - ground metres
/// above it along `up`, the vehicle's z axis in the world, of length 1. For a sensor that is
/// mounted upright that is the z of the ground on the line through the point along the sensor's own
/// z axis. `xyzi` holds 4 floats a point as SimulatedScan does.
///
/// The line leans with the vehicle, so that it may meet a steep face more than once: what counts is
/// the first ground on the way down from a point above the ground, or up from one below. NaN where
/// the ground does not cover the point or the way, and for (0, 0, 0), which is no echo at all.
std::vector<float> true_ground(const Ground& ground, const Frame& pose, Vector3 up,
                               std::span<const float> xyzi);

/// The same for a sensor that is mounted upright.
std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi);

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "lab/sim/mesh.hpp"
#include "lab/sim/semantic_class.hpp"

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

}  // namespace flagstone::sim

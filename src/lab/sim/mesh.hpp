// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/semantic_class.hpp"
#include "lab/sim/vector3.hpp"

namespace flagstone::sim {

/// What a triangle is made of.
struct Surface {
  SemanticClass semantic = SemanticClass::other_ground;
  float reflectivity = 0.3f;  ///< share of the light sent back at normal incidence, 0..1
  float mirror = 0;  ///< how well it mirrors beams, 0..1: 0 dry, 1 window glass, still water
};

/// Triangles in the world frame. Which way round a triangle runs does not matter: a beam hits both
/// sides.
class Mesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Returns the index of the new vertex.
  std::uint32_t add_vertex(Vector3 position);

  /// `corners` are indices of vertices added before.
  void add_triangle(Triangle corners, Surface surface);

  /// A triangle with vertices of its own.
  void add_triangle(Vector3 a, Vector3 b, Vector3 c, Surface surface);

  /// The triangles abc and acd: a, b, c, d run round the quad's edge.
  void add_quad(Vector3 a, Vector3 b, Vector3 c, Vector3 d, Surface surface);

  [[nodiscard]] const std::vector<Vector3>& vertices() const noexcept { return vertices_; }
  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  [[nodiscard]] const Surface& surface(std::size_t triangle) const noexcept {
    return surfaces_[triangle];
  }
  /// Corner 0, 1 or 2 of a triangle.
  [[nodiscard]] Vector3 corner(std::size_t triangle, std::size_t corner) const noexcept {
    return vertices_[triangles_[triangle][corner]];
  }

 private:
  std::vector<Vector3> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Surface> surfaces_;  // one per triangle
};

}  // namespace flagstone::sim

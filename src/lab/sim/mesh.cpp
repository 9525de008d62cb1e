// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

std::uint32_t Mesh::add_vertex(Vector3 position) {
  vertices_.push_back(position);
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

void Mesh::add_triangle(Triangle corners, Surface surface) {
  triangles_.push_back(corners);
  surfaces_.push_back(surface);
}

void Mesh::add_triangle(Vector3 a, Vector3 b, Vector3 c, Surface surface) {
  const std::uint32_t first = add_vertex(a);
  add_vertex(b);
  add_vertex(c);
  add_triangle({first, first + 1, first + 2}, surface);
}

void Mesh::add_quad(Vector3 a, Vector3 b, Vector3 c, Vector3 d, Surface surface) {
  const std::uint32_t first = add_vertex(a);
  add_vertex(b);
  add_vertex(c);
  add_vertex(d);
  add_triangle({first, first + 1, first + 2}, surface);
  add_triangle({first, first + 2, first + 3}, surface);
}

}  // namespace flagstone::sim

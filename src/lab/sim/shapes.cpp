// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/shapes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flagstone::sim {
namespace {

Vector3 random_direction(Random& random) {
  while (true) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    const double squared = x * x + y * y + z * z;
    if (squared > 1e-4 && squared <= 1) return normalized({x, y, z});
  }
}

// Any direction at right angles to `axis`.
Vector3 perpendicular(Vector3 axis) {
  return normalized(cross(axis, std::abs(axis.z) < 0.9 ? Vector3{0, 0, 1} : Vector3{1, 0, 0}));
}

std::array<Vector3, 4> corners(const Frame& frame, const Section& section) {
  return {frame.to_world({section.x, -section.half_width_low, section.low}),
          frame.to_world({section.x, section.half_width_low, section.low}),
          frame.to_world({section.x, section.half_width_high, section.high}),
          frame.to_world({section.x, -section.half_width_high, section.high})};
}

}  // namespace

void add_box(Mesh& mesh, const Frame& frame, const Box& box, Surface surface) {
  const Frame middle{.origin = frame.to_world({0, (box.low.y + box.high.y) / 2, 0}),
                     .forward = frame.forward,
                     .left = frame.left,
                     .up = frame.up};
  const double half_width = (box.high.y - box.low.y) / 2;
  const auto end = [&](double x) {
    return Section{.x = x,
                   .low = box.low.z,
                   .high = box.high.z,
                   .half_width_low = half_width,
                   .half_width_high = half_width};
  };
  add_loft(mesh, middle, std::array{end(box.low.x), end(box.high.x)}, surface);
}

void add_loft(Mesh& mesh, const Frame& frame, std::span<const Section> sections, Surface surface) {
  std::array<Vector3, 4> behind = corners(frame, sections.front());
  mesh.add_quad(behind[0], behind[1], behind[2], behind[3], surface);
  for (const Section& section : sections.subspan(1)) {
    const std::array<Vector3, 4> ahead = corners(frame, section);
    for (std::size_t edge = 0; edge < 4; ++edge) {
      const std::size_t next = (edge + 1) % 4;
      mesh.add_quad(behind[edge], behind[next], ahead[next], ahead[edge], surface);
    }
    behind = ahead;
  }
  mesh.add_quad(behind[0], behind[1], behind[2], behind[3], surface);
}

void add_cone(Mesh& mesh, const Frame& frame, const Cone& cone, Surface surface) {
  const Vector3 from = frame.to_world(cone.from);
  const Vector3 to = frame.to_world(cone.to);
  const Vector3 axis = normalized(to - from);
  const Vector3 first = perpendicular(axis);
  const Vector3 second = cross(axis, first);
  const auto spoke = [&](int side) {
    const double angle = 2 * std::numbers::pi * side / cone.sides;
    return std::cos(angle) * first + std::sin(angle) * second;
  };
  for (int side = 0; side < cone.sides; ++side) {
    const Vector3 one = spoke(side);
    const Vector3 next = spoke(side + 1);
    mesh.add_quad(from + cone.radius_from * one, from + cone.radius_from * next,
                  to + cone.radius_to * next, to + cone.radius_to * one, surface);
    mesh.add_triangle(from, from + cone.radius_from * one, from + cone.radius_from * next, surface);
    mesh.add_triangle(to, to + cone.radius_to * one, to + cone.radius_to * next, surface);
  }
}

void add_leaves(Mesh& mesh, const Leaves& leaves, Surface surface, Random& random) {
  for (int leaf = 0; leaf < leaves.count; ++leaf) {
    const Vector3 outward = std::sqrt(random.uniform()) * random_direction(random);
    const Vector3 centre =
        leaves.centre +
        Vector3{leaves.radii.x * outward.x, leaves.radii.y * outward.y, leaves.radii.z * outward.z};
    const Vector3 facing = random_direction(random);
    const double half = leaves.size * random.uniform(0.25, 0.75);
    const Vector3 a = half * perpendicular(facing);
    const Vector3 b = cross(facing, a);
    mesh.add_quad(centre - a - b, centre + a - b, centre + a + b, centre - a + b, surface);
  }
}

}  // namespace flagstone::sim

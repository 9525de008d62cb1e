// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flagstone::sim {

std::string_view name_of(SemanticClass semantic) noexcept {
  switch (semantic) {
    case SemanticClass::outlier: return "outlier";
    case SemanticClass::car: return "car";
    case SemanticClass::bus: return "bus";
    case SemanticClass::truck: return "truck";
    case SemanticClass::other_vehicle: return "other-vehicle";
    case SemanticClass::person: return "person";
    case SemanticClass::bicyclist: return "bicyclist";
    case SemanticClass::road: return "road";
    case SemanticClass::parking: return "parking";
    case SemanticClass::sidewalk: return "sidewalk";
    case SemanticClass::other_ground: return "other-ground";
    case SemanticClass::building: return "building";
    case SemanticClass::fence: return "fence";
    case SemanticClass::other_structure: return "other-structure";
    case SemanticClass::lane_marking: return "lane-marking";
    case SemanticClass::vegetation: return "vegetation";
    case SemanticClass::trunk: return "trunk";
    case SemanticClass::terrain: return "terrain";
    case SemanticClass::pole: return "pole";
    case SemanticClass::traffic_sign: return "traffic-sign";
    case SemanticClass::other_object: return "other-object";
    case SemanticClass::moving_car: return "moving-car";
    case SemanticClass::moving_bicyclist: return "moving-bicyclist";
    case SemanticClass::moving_person: return "moving-person";
    case SemanticClass::moving_bus: return "moving-bus";
    case SemanticClass::moving_truck: return "moving-truck";
    case SemanticClass::moving_other_vehicle: return "moving-other-vehicle";
  }
  return {};
}

SemanticClass labelled_class(const Surface& surface) noexcept {
  if (surface.motion != Motion::now) return surface.semantic;
  switch (surface.semantic) {
    case SemanticClass::car: return SemanticClass::moving_car;
    case SemanticClass::bicyclist: return SemanticClass::moving_bicyclist;
    case SemanticClass::person: return SemanticClass::moving_person;
    case SemanticClass::bus: return SemanticClass::moving_bus;
    case SemanticClass::truck: return SemanticClass::moving_truck;
    case SemanticClass::other_vehicle: return SemanticClass::moving_other_vehicle;
    default: return surface.semantic;
  }
}

Surface random_shade(SemanticClass semantic, Interval reflectivity, Random& random) {
  return {.semantic = semantic,
          .reflectivity = static_cast<float>(random.uniform(reflectivity.low, reflectivity.high))};
}

std::uint32_t Mesh::add_vertex(Vector3 position) {
  vertices_.push_back(position);
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

void Mesh::add_triangle(Triangle corners, Surface surface) {
  triangles_.push_back(corners);
  surfaces_.push_back(surface);
}

void Mesh::move(const std::function<Vector3(Vector3)>& to) {
  for (Vector3& vertex : vertices_) vertex = to(vertex);
}

void Mesh::set_motion(std::size_t first, Motion motion) {
  for (std::size_t i = first; i < surfaces_.size(); ++i) surfaces_[i].motion = motion;
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

// Some direction at right angles to `axis`.
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

namespace {

void close_end(Mesh& mesh, std::span<const Vector3> corners, Surface surface) {
  for (std::size_t i = 1; i + 2 < corners.size(); ++i) {
    mesh.add_triangle(corners[0], corners[i], corners[i + 1], surface);
  }
}

}  // namespace

void add_extrusion(Mesh& mesh, std::span<const OutlinePoint> outline, Interval x, double step,
                   const RoadPlace& place, Surface surface) {
  const auto corners_at = [&](double at) {
    std::vector<Vector3> corners;
    for (const OutlinePoint& point : outline) corners.push_back(place(at, point.t, point.z));
    return corners;
  };
  const OutlinePoint first = outline.front();
  const OutlinePoint last = outline.back();
  const bool encloses = first.t == last.t && first.z == last.z;
  const int pieces = std::max(1, static_cast<int>(std::ceil((x.high - x.low) / step - 1e-9)));
  std::vector<Vector3> behind = corners_at(x.low);
  if (encloses) close_end(mesh, behind, surface);
  for (int piece = 1; piece <= pieces; ++piece) {
    const std::vector<Vector3> ahead = corners_at(x.low + (x.high - x.low) * piece / pieces);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      mesh.add_quad(behind[i], behind[i + 1], ahead[i + 1], ahead[i], surface);
    }
    behind = ahead;
  }
  if (encloses) close_end(mesh, behind, surface);
}

void add_beam(Mesh& mesh, const BeamSection& section, Interval x, double step,
              const RoadPlace& place, Surface surface) {
  const auto& [t, z] = section;
  add_extrusion(mesh,
                std::array{OutlinePoint{t.low, z.low}, OutlinePoint{t.high, z.low},
                           OutlinePoint{t.high, z.high}, OutlinePoint{t.low, z.high},
                           OutlinePoint{t.low, z.low}},
                x, step, place, surface);
}

}  // namespace flagstone::sim

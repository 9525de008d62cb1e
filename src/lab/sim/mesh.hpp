// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Classes of surfaces, with the label ids of SemanticKITTI. J. Behley et al., "SemanticKITTI: A
/// Dataset for Semantic Scene Understanding of LiDAR Sequences", ICCV 2019.
enum class SemanticClass : std::uint16_t {
  outlier = 1,  ///< not a surface: ghost points, mixed pixels, rain, dust, crosstalk
  car = 10,
  bus = 13,
  truck = 18,
  other_vehicle = 20,  ///< excavators, tractors, forklifts
  person = 30,
  bicyclist = 31,  ///< with the bicycle
  road = 40,
  parking = 44,
  sidewalk = 48,  ///< including kerb faces, which annotators label as sidewalk
  other_ground = 49,
  building = 50,
  fence = 51,            ///< including crash barriers and low walls
  other_structure = 52,  ///< retaining walls, tunnels, gantries, shelters, racks
  lane_marking = 60,
  vegetation = 70,
  trunk = 71,
  terrain = 72,
  pole = 80,
  traffic_sign = 81,
  other_object = 99,  ///< benches, bins, pallets, heaps and similar objects

  /// @name Objects that move at the time of the scan
  /// @{
  moving_car = 252,
  moving_bicyclist = 253,
  moving_person = 254,
  moving_bus = 257,
  moving_truck = 258,
  moving_other_vehicle = 259,
  /// @}
};

/// Motion of an object, with the codes of the files NNNNNN.motion.npy.
enum class Motion : std::uint8_t {
  none,   ///< static, or a return without an object
  later,  ///< stands still at the time of the scan, and moves at another time of the run
  now,    ///< moves at the time of the scan
};
inline constexpr std::array<std::string_view, 3> motion_names{"none", "later", "now"};

/// The name in SemanticKITTI, for example "lane-marking"; empty for an unknown code.
std::string_view name_of(SemanticClass semantic) noexcept;

/// Whether this is a class of the ground (40, 44, 48, 49, 60, 72).
constexpr bool is_ground(SemanticClass semantic) noexcept {
  switch (semantic) {
    case SemanticClass::road:
    case SemanticClass::parking:
    case SemanticClass::sidewalk:
    case SemanticClass::other_ground:
    case SemanticClass::lane_marking:
    case SemanticClass::terrain: return true;
    default: return false;
  }
}

/// The surface of a triangle.
struct Surface {
  SemanticClass semantic = SemanticClass::other_ground;
  float reflectivity = 0.3f;  ///< fraction of the light returned at normal incidence, 0..1
  float mirror = 0;  ///< specular reflection, 0..1: 0 dry surfaces; 1 window glass, still water
  Motion motion = Motion::none;  ///< of the object
};

/// The class of the surface in label files: the class of a moving object if the surface moves now.
SemanticClass labelled_class(const Surface& surface) noexcept;

/// A surface with a reflectivity drawn from an interval.
Surface random_shade(SemanticClass semantic, Interval reflectivity, Random& random);

/// Triangles in the world frame. Their orientation does not matter: a beam hits both sides.
class Mesh {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Returns the index of the new vertex.
  std::uint32_t add_vertex(Vector3 position);

  /// `corners` are indices of vertices added before.
  void add_triangle(Triangle corners, Surface surface);

  /// Adds a triangle with new vertices.
  void add_triangle(Vector3 a, Vector3 b, Vector3 c, Surface surface);

  /// Adds the triangles abc and acd; a, b, c, d are in order around the quad.
  void add_quad(Vector3 a, Vector3 b, Vector3 c, Vector3 d, Surface surface);

  /// Replaces the position of every vertex.
  void move(const std::function<Vector3(Vector3)>& to);

  /// Sets the motion of all triangles from `first` on.
  void set_motion(std::size_t first, Motion motion);

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

/// A box in a frame: the two corners with the smallest and the largest coordinates, metres.
struct Box {
  Vector3 low, high;
};
void add_box(Mesh& mesh, const Frame& frame, const Box& box, Surface surface);

/// A cross-section of a body at `x`: a trapezoid in the y-z plane of the frame, symmetric in y.
struct Section {
  double x = 0;
  double low = 0, high = 0;                        ///< heights of the lower and upper edge, metres
  double half_width_low = 0, half_width_high = 0;  ///< at those edges, metres
};
/// Adds a closed body through the sections, which must be ordered by x.
void add_loft(Mesh& mesh, const Frame& frame, std::span<const Section> sections, Surface surface);

/// A closed truncated cone along the straight line from `from` to `to` in the frame; `sides` >= 3.
struct Cone {
  Vector3 from, to;
  double radius_from = 0, radius_to = 0;  ///< metres
  int sides = 10;
};
void add_cone(Mesh& mesh, const Frame& frame, const Cone& cone, Surface surface);

/// Leaves in an ellipsoid: randomly oriented squares, denser towards its surface.
struct Leaves {
  Vector3 centre;  ///< world frame
  Vector3 radii;   ///< half axes along x, y and z, metres
  int count = 0;
  double size = 0.15;  ///< mean edge of a leaf, metres; leaves vary by 50 %
};
void add_leaves(Mesh& mesh, const Leaves& leaves, Surface surface, Random& random);

/// Converts road coordinates to the world frame: x along the road, t to the left of its centre
/// line, z above a level that the road defines. Metres.
using RoadPlace = std::function<Vector3(double x, double t, double z)>;

/// A point of an outline across a road.
struct OutlinePoint {
  double t, z;
};

/// Extrudes an outline along a road from x.low to x.high, in straight pieces of at most `step`
/// metres: walls, rails, vaults. A closed outline makes a body with closed ends and must be convex.
void add_extrusion(Mesh& mesh, std::span<const OutlinePoint> outline, Interval x, double step,
                   const RoadPlace& place, Surface surface);

/// The outline of a rectangle.
struct BeamSection {
  Interval t, z;
};
/// Adds a body of rectangular section along a road: walls, beams, slabs.
void add_beam(Mesh& mesh, const BeamSection& section, Interval x, double step,
              const RoadPlace& place, Surface surface);

}  // namespace flagstone::sim

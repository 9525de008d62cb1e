// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/machines.hpp"

#include <array>
#include <cmath>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.22F};
constexpr Surface paint{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.45F};
constexpr Surface glass{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.06F};
constexpr Surface rubber{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.07F};

struct Wheel {
  double x, outside;  // of its outer face, metres left
  double radius, width;
};

void add_wheel_pair(Mesh& mesh, const Frame& frame, const Wheel& wheel) {
  for (const double side : {-1.0, 1.0}) {
    add_cone(mesh, frame,
             {.from = {wheel.x, side * (wheel.outside - wheel.width), wheel.radius},
              .to = {wheel.x, side * wheel.outside, wheel.radius},
              .radius_from = wheel.radius,
              .radius_to = wheel.radius,
              .sides = 16},
             rubber);
  }
}

// A beam of square section between two points of the frame's x-z plane.
void add_beam(Mesh& mesh, const Frame& frame, Vector3 from, Vector3 to, double width) {
  add_cone(mesh, frame,
           {.from = from, .to = to, .radius_from = width, .radius_to = 0.8 * width, .sides = 4},
           paint);
}

}  // namespace

void add_tractor(Mesh& mesh, const Frame& frame, int shares, Random& random) {
  const Surface body{.semantic = SemanticClass::other_vehicle,
                     .reflectivity = static_cast<float>(random.uniform(0.2, 0.5))};
  add_wheel_pair(mesh, frame, {.x = -1, .outside = 1.15, .radius = 0.85, .width = 0.5});
  add_wheel_pair(mesh, frame, {.x = 1.4, .outside = 1.05, .radius = 0.6, .width = 0.4});
  add_box(mesh, frame, {.low = {-1.4, -0.4, 0.6}, .high = {2.1, 0.4, 1.1}}, steel);
  add_box(mesh, frame, {.low = {0.3, -0.42, 1}, .high = {2.2, 0.42, 1.65}}, body);
  add_box(mesh, frame, {.low = {-1.4, -0.75, 1}, .high = {0.3, 0.75, 1.6}}, body);
  add_box(mesh, frame, {.low = {-1.35, -0.7, 1.6}, .high = {0.25, 0.7, 2.65}}, glass);
  add_box(mesh, frame, {.low = {-1.5, -0.8, 2.65}, .high = {0.4, 0.8, 2.8}}, body);
  if (shares == 0) return;
  constexpr double pitch = 0.9;  // from share to share along the plough
  const double end = -1.8 - pitch * shares;
  add_beam(mesh, frame, {-1.4, 0, 0.8}, {end, -0.2 * shares, 0.9}, 0.1);
  for (int share = 0; share < shares; ++share) {
    const double x = -2.1 - pitch * share;
    const double y = -0.2 * share;
    add_box(mesh, frame, {.low = {x - 0.1, y - 0.05, 0.1}, .high = {x + 0.1, y + 0.05, 0.9}},
            steel);
    add_box(mesh, frame, {.low = {x - 0.3, y - 0.3, -0.05}, .high = {x + 0.2, y, 0.35}}, steel);
  }
}

void add_excavator(Mesh& mesh, const Frame& frame, const ExcavatorPose& pose) {
  for (const double side : {-1.0, 1.0}) {
    const double middle = side * 1.1;
    const auto at = [](double x, double low) {
      return Section{
          .x = x, .low = low, .high = 0.95 - low, .half_width_low = 0.3, .half_width_high = 0.3};
    };
    Frame track = frame;
    track.origin = frame.to_world({0, middle, 0});
    add_loft(mesh, track, std::array{at(-2, 0.3), at(-1.6, 0), at(1.6, 0), at(2, 0.3)}, rubber);
  }
  Frame upper = frame;
  upper.forward = std::cos(pose.swing) * frame.forward + std::sin(pose.swing) * frame.left;
  upper.left = cross(frame.up, upper.forward);
  add_cone(mesh, upper,
           {.from = {0, 0, 0.6}, .to = {0, 0, 1.1}, .radius_from = 0.7, .radius_to = 0.7}, steel);
  add_box(mesh, upper, {.low = {-2, -1.25, 1.05}, .high = {1, 1.25, 1.35}}, steel);
  add_box(mesh, upper, {.low = {-2.2, -1.25, 1.35}, .high = {-0.6, 1.25, 2.2}}, paint);
  add_box(mesh, upper, {.low = {-0.5, 0.3, 1.35}, .high = {1.1, 1.2, 2.9}}, glass);
  constexpr double boom_length = 4.6;
  constexpr double stick_length = 2.7;
  const Vector3 foot{0.9, -0.3, 1.6};
  const Vector3 elbow = foot + boom_length * Vector3{std::cos(pose.boom), 0, std::sin(pose.boom)};
  const double bent = pose.boom - 1.7;
  const Vector3 wrist = elbow + stick_length * Vector3{std::cos(bent), 0, std::sin(bent)};
  add_beam(mesh, upper, foot, elbow, 0.28);
  add_beam(mesh, upper, elbow, wrist, 0.2);
  const Frame bucket{.origin = upper.to_world(wrist),
                     .forward = upper.forward,
                     .left = upper.left,
                     .up = upper.up};
  add_loft(mesh, bucket,
           std::array{Section{-0.7, -0.6, -0.3, 0.55, 0.55}, Section{-0.1, -0.9, 0.1, 0.55, 0.55},
                      Section{0.3, -0.5, 0, 0.55, 0.55}},
           steel);
}

}  // namespace flagstone::sim

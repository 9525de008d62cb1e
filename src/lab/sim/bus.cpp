// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/bus.hpp"

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface glass{.semantic = SemanticClass::bus, .reflectivity = 0.06F};
constexpr Surface rubber{.semantic = SemanticClass::bus, .reflectivity = 0.08F};
constexpr double half_length = bus_length / 2;
constexpr double half_width = bus_width / 2;

}  // namespace

void add_bus(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface paint{.semantic = SemanticClass::bus,
                      .reflectivity = static_cast<float>(random.uniform(0.15, 0.6))};
  constexpr double floor = 0.32;
  constexpr double belt = 1.15;
  constexpr double roof = 2.55;
  constexpr double height = 3.05;
  constexpr double inset = 0.04;  // of the windows
  const auto layer = [&](double low, double high, double in, Surface surface) {
    add_box(mesh, frame,
            {.low = {-half_length + in, -half_width + in, low},
             .high = {half_length - in, half_width - in, high}},
            surface);
  };
  layer(floor, belt, 0, paint);
  layer(belt, roof, inset, glass);
  layer(roof, height, 0, paint);
  constexpr double post_pitch = 1.9;
  for (double x = -half_length; x < half_length; x += post_pitch) {
    for (const double side : {-1.0, 1.0}) {
      const double y = side * (half_width - 0.02);
      add_box(mesh, frame, {.low = {x, y - 0.02, belt}, .high = {x + 0.15, y + 0.02, roof}}, paint);
    }
  }
  constexpr double radius = 0.48;
  for (const double axle : {-half_length + 3.2, half_length - 2.7}) {
    for (const double side : {-1.0, 1.0}) {
      add_cone(mesh, frame,
               {.from = {axle, side * (half_width - 0.3), radius},
                .to = {axle, side * (half_width + 0.01), radius},
                .radius_from = radius,
                .radius_to = radius,
                .sides = 14},
               rubber);
    }
  }
}

}  // namespace flagstone::sim

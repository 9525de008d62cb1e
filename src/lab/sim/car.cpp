// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/car.hpp"

#include <array>
#include <cstddef>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface glass{.semantic = SemanticClass::car, .reflectivity = 0.06F};
constexpr Surface rubber{.semantic = SemanticClass::car, .reflectivity = 0.08F};
constexpr double clearance = 0.2;  // below the body, metres

// Lengths in metres, places along the car as shares of its length from the rear (0) to the front
// (1).
struct CarKind {
  double length, width, height;
  double belt;                   // height of the lower edge of the windows
  double rear_glass, roof_rear;  // where the rear window begins and ends
  double roof_front, bonnet;     // where the windscreen begins and ends
};
constexpr std::array<CarKind, 4> kinds{{
    {.length = 3.9,
     .width = 1.7,
     .height = 1.48,
     .belt = 0.92,
     .rear_glass = 0.02,
     .roof_rear = 0.12,
     .roof_front = 0.56,
     .bonnet = 0.76},  // hatchback
    {.length = 4.7,
     .width = 1.8,
     .height = 1.45,
     .belt = 0.93,
     .rear_glass = 0.16,
     .roof_rear = 0.32,
     .roof_front = 0.56,
     .bonnet = 0.73},  // saloon
    {.length = 4.6,
     .width = 1.8,
     .height = 1.5,
     .belt = 0.95,
     .rear_glass = 0.01,
     .roof_rear = 0.08,
     .roof_front = 0.58,
     .bonnet = 0.74},  // estate
    {.length = longest_car,
     .width = 1.95,
     .height = 2.1,
     .belt = 1.15,
     .rear_glass = 0,
     .roof_rear = 0.03,
     .roof_front = 0.74,
     .bonnet = 0.86},  // van
}};

void add_body(Mesh& mesh, const Frame& frame, const CarKind& kind, Surface paint) {
  const double half = kind.width / 2;
  const auto at = [&](double share, double low, double high) {
    return Section{.x = (share - 0.5) * kind.length,
                   .low = low,
                   .high = high,
                   .half_width_low = half,
                   .half_width_high = half - 0.05};
  };
  const double bonnet_nose = kind.belt - 0.2;
  add_loft(mesh, frame,
           std::array{at(0, 0.35, 0.6), at(0.02, clearance + 0.1, kind.belt - 0.05),
                      at(0.1, clearance, kind.belt), at(kind.bonnet, clearance, kind.belt),
                      at(0.96, clearance, bonnet_nose), at(1, 0.3, 0.55)},
           paint);
}

void add_cabin(Mesh& mesh, const Frame& frame, const CarKind& kind, Surface paint) {
  const double half = kind.width / 2 - 0.06;
  constexpr double lean = 0.14;  // of the side windows
  constexpr double roof = 0.06;  // its thickness
  const auto at = [&](double share, double low, double high) {
    return Section{.x = (share - 0.5) * kind.length,
                   .low = low,
                   .high = high,
                   .half_width_low = half,
                   .half_width_high = half - lean};
  };
  const double windows = kind.height - roof;
  add_loft(mesh, frame,
           std::array{at(kind.rear_glass, kind.belt - 0.02, kind.belt),
                      at(kind.roof_rear, kind.belt - 0.02, windows),
                      at(kind.roof_front, kind.belt - 0.02, windows),
                      at(kind.bonnet, kind.belt - 0.02, kind.belt)},
           glass);
  const auto roof_at = [&](double share) {
    return Section{.x = (share - 0.5) * kind.length,
                   .low = windows,
                   .high = kind.height,
                   .half_width_low = half - lean,
                   .half_width_high = half - 2 * lean};
  };
  add_loft(mesh, frame, std::array{roof_at(kind.roof_rear), roof_at(kind.roof_front)}, paint);
}

void add_wheels(Mesh& mesh, const Frame& frame, const CarKind& kind) {
  constexpr double radius = 0.31;
  constexpr double thickness = 0.2;
  for (const double axle : {0.2, 0.81}) {
    for (const double side : {-1.0, 1.0}) {
      const double x = (axle - 0.5) * kind.length;
      const double outside = side * (kind.width / 2 + 0.01);
      add_cone(mesh, frame,
               {.from = {x, outside - side * thickness, radius},
                .to = {x, outside, radius},
                .radius_from = radius,
                .radius_to = radius,
                .sides = 14},
               rubber);
    }
  }
}

}  // namespace

void add_car(Mesh& mesh, const Frame& frame, Random& random) {
  const CarKind& kind =
      kinds[static_cast<std::size_t>(random.uniform() * static_cast<double>(kinds.size()))];
  const Surface paint{.semantic = SemanticClass::car,
                      .reflectivity = static_cast<float>(random.uniform(0.06, 0.4))};
  add_body(mesh, frame, kind, paint);
  add_cabin(mesh, frame, kind, paint);
  add_wheels(mesh, frame, kind);
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/vehicles.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

namespace {

Surface glass(SemanticClass semantic) { return {.semantic = semantic, .reflectivity = 0.06F}; }
Surface rubber(SemanticClass semantic) { return {.semantic = semantic, .reflectivity = 0.08F}; }

// The wheels of one axle: distances of their inner and outer faces from the middle, metres.
struct Wheels {
  double axle, inside, outside, radius;
  int sides = 14;
};
void add_wheels(Mesh& mesh, const Frame& frame, const Wheels& wheels, Surface surface) {
  const auto& [axle, inside, outside, radius, sides] = wheels;
  for (const double side : {-1.0, 1.0}) {
    add_cone(mesh, frame,
             {.from = {axle, side * inside, radius},
              .to = {axle, side * outside, radius},
              .radius_from = radius,
              .radius_to = radius,
              .sides = sides},
             surface);
  }
}

constexpr double car_clearance = 0.2;  // below the body, metres

// Lengths in metres; positions along the car as fractions of its length, from the rear (0) to the
// front (1).
struct CarKind {
  double length, width, height;
  double belt;                   // height of the lower edge of the windows
  double rear_glass, roof_rear;  // start and end of the rear window
  double roof_front, bonnet;     // start and end of the windscreen
};
constexpr std::array<CarKind, 4> car_kinds{{
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

void add_car_body(Mesh& mesh, const Frame& frame, const CarKind& kind, Surface paint) {
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
           std::array{at(0, 0.35, 0.6), at(0.02, car_clearance + 0.1, kind.belt - 0.05),
                      at(0.1, car_clearance, kind.belt), at(kind.bonnet, car_clearance, kind.belt),
                      at(0.96, car_clearance, bonnet_nose), at(1, 0.3, 0.55)},
           paint);
}

void add_car_cabin(Mesh& mesh, const Frame& frame, const CarKind& kind, Surface paint) {
  const double half = kind.width / 2 - 0.06;
  constexpr double lean = 0.14;  // inward tilt of the side windows, metres
  constexpr double roof = 0.06;  // thickness
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
           glass(SemanticClass::car));
  const auto roof_at = [&](double share) {
    return Section{.x = (share - 0.5) * kind.length,
                   .low = windows,
                   .high = kind.height,
                   .half_width_low = half - lean,
                   .half_width_high = half - 2 * lean};
  };
  add_loft(mesh, frame, std::array{roof_at(kind.roof_rear), roof_at(kind.roof_front)}, paint);
}

}  // namespace

void add_car(Mesh& mesh, const Frame& frame, Random& random) {
  const CarKind& kind =
      car_kinds[static_cast<std::size_t>(random.uniform() * static_cast<double>(car_kinds.size()))];
  const Surface paint = random_shade(SemanticClass::car, {0.06, 0.4}, random);
  add_car_body(mesh, frame, kind, paint);
  add_car_cabin(mesh, frame, kind, paint);
  constexpr double radius = 0.31;
  constexpr double thickness = 0.2;
  for (const double axle : {0.2, 0.81}) {
    const double outside = kind.width / 2 + 0.01;
    add_wheels(mesh, frame, {(axle - 0.5) * kind.length, outside - thickness, outside, radius},
               rubber(SemanticClass::car));
  }
}

void add_bus(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface paint = random_shade(SemanticClass::bus, {0.15, 0.6}, random);
  constexpr double half_length = bus_length / 2;
  constexpr double half_width = bus_width / 2;
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
  layer(belt, roof, inset, glass(SemanticClass::bus));
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
    add_wheels(mesh, frame, {axle, half_width - 0.3, half_width + 0.01, radius},
               rubber(SemanticClass::bus));
  }
}

namespace {

constexpr Surface truck_steel{.semantic = SemanticClass::truck, .reflectivity = 0.2F};
constexpr double truck_front = truck_length / 2;
constexpr double cab_rear = truck_front - 2.2;
constexpr double trailer_front = truck_front - 2.6;
constexpr double truck_half = truck_width / 2;

void add_cab(Mesh& mesh, const Frame& frame, double roof, Surface paint) {
  constexpr double windscreen = 1.9;
  add_box(mesh, frame,
          {.low = {cab_rear, -truck_half, 0.5}, .high = {truck_front, truck_half, windscreen}},
          paint);
  // A box of glass, and the roof and the rear wall around it.
  add_box(mesh, frame,
          {.low = {cab_rear + 0.8, -truck_half + 0.03, windscreen},
           .high = {truck_front - 0.1, truck_half - 0.03, windscreen + 0.9}},
          glass(SemanticClass::truck));
  add_box(mesh, frame,
          {.low = {cab_rear, -truck_half, windscreen}, .high = {cab_rear + 0.8, truck_half, roof}},
          paint);
  add_loft(mesh, frame,
           std::array{Section{.x = cab_rear + 0.8,
                              .low = windscreen + 0.9,
                              .high = roof,
                              .half_width_low = truck_half,
                              .half_width_high = truck_half - 0.1},
                      Section{.x = truck_front - 0.1,
                              .low = windscreen + 0.9,
                              .high = windscreen + 1.1,
                              .half_width_low = truck_half,
                              .half_width_high = truck_half - 0.1}},
           paint);
}

void add_trailer(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface load = random_shade(SemanticClass::truck, {0.15, 0.55}, random);
  constexpr double bed = 1.15;
  add_box(mesh, frame, {.low = {-truck_front, -0.5, 0.8}, .high = {trailer_front, 0.5, bed}},
          truck_steel);
  const double drawn = random.uniform();
  if (drawn < 0.6) {
    add_box(mesh, frame,
            {.low = {-truck_front, -truck_half, bed}, .high = {trailer_front, truck_half, 3.9}},
            load);
  } else if (drawn < 0.8) {
    add_cone(mesh, frame,
             {.from = {-truck_front, 0, bed + 1.15},
              .to = {trailer_front, 0, bed + 1.15},
              .radius_from = 1.15,
              .radius_to = 1.15,
              .sides = 16},
             load);
  } else {
    add_box(
        mesh, frame,
        {.low = {-truck_front, -truck_half, bed - 0.1}, .high = {trailer_front, truck_half, bed}},
        truck_steel);
    const double end = random.uniform(0, trailer_front - 1);
    add_box(mesh, frame,
            {.low = {-truck_front + 1, -truck_half + 0.2, bed},
             .high = {end, truck_half - 0.2, random.uniform(1.8, 3)}},
            load);
  }
}

}  // namespace

void add_truck(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface paint = random_shade(SemanticClass::truck, {0.08, 0.5}, random);
  add_cab(mesh, frame, random.uniform(3, 3.8), paint);
  add_box(mesh, frame, {.low = {truck_front - 5.6, -0.45, 0.6}, .high = {cab_rear, 0.45, 0.95}},
          truck_steel);
  add_trailer(mesh, frame, random);
  for (const double axle : {truck_front - 1.3, truck_front - 4.6, -truck_front + 2,
                            -truck_front + 3.3, -truck_front + 4.6}) {
    add_wheels(mesh, frame, {axle, truck_half - 0.5, truck_half, 0.5},
               rubber(SemanticClass::truck));
  }
}

void add_forklift(Mesh& mesh, const Frame& frame, Random& random) {
  constexpr Surface steel{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.2F};
  constexpr Surface driver{.semantic = SemanticClass::person, .reflectivity = 0.3F};
  constexpr double rear = -forklift_length / 2;
  constexpr double half = forklift_width / 2;
  constexpr double mast = 0.55;  // x; the body is behind it, the fork in front
  const Surface paint = random_shade(SemanticClass::other_vehicle, {0.3, 0.6}, random);
  add_box(mesh, frame, {.low = {rear, -half + 0.05, 0.15}, .high = {mast - 0.1, half - 0.05, 0.7}},
          paint);
  add_box(mesh, frame, {.low = {rear, -half + 0.05, 0.7}, .high = {rear + 0.6, half - 0.05, 1.1}},
          paint);
  add_box(mesh, frame, {.low = {-0.8, -0.22, 0.7}, .high = {-0.5, 0.22, 1.55}}, driver);
  add_box(mesh, frame, {.low = {-0.75, -0.1, 1.55}, .high = {-0.55, 0.1, 1.8}}, driver);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - 0.15);
    add_box(mesh, frame, {.low = {mast - 0.1, y - 0.06, 0.05}, .high = {mast, y + 0.06, 2.2}},
            steel);
    add_box(mesh, frame, {.low = {rear + 0.5, y - 0.03, 1.1}, .high = {rear + 0.56, y + 0.03, 2.1}},
            steel);
    add_box(mesh, frame,
            {.low = {mast, side * 0.3 - 0.06, 0.08}, .high = {-rear, side * 0.3 + 0.06, 0.12}},
            steel);
  }
  add_box(mesh, frame, {.low = {rear + 0.4, -half + 0.1, 2.1}, .high = {mast, half - 0.1, 2.14}},
          steel);
  for (const double axle : {rear + 0.4, mast - 0.3}) {
    add_wheels(mesh, frame, {axle, half - 0.22, half, 0.28, 10}, steel);
  }
  if (random.chance(0.6)) {
    const Surface load = random_shade(SemanticClass::other_object, {0.3, 0.6}, random);
    add_box(mesh, frame,
            {.low = {mast + 0.05, -half, 0.12}, .high = {-rear, half, random.uniform(0.8, 1.6)}},
            load);
  }
}

namespace {

constexpr Surface machine_steel{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.22F};
constexpr Surface machine_paint{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.45F};
constexpr Surface machine_glass{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.06F};
constexpr Surface machine_rubber{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.07F};

// A beam of square section between two points in the x-z plane of the frame.
void add_arm(Mesh& mesh, const Frame& frame, Vector3 from, Vector3 to, double width) {
  add_cone(mesh, frame,
           {.from = from, .to = to, .radius_from = width, .radius_to = 0.8 * width, .sides = 4},
           machine_paint);
}

}  // namespace

void add_tractor(Mesh& mesh, const Frame& frame, int shares, Random& random) {
  const Surface body = random_shade(SemanticClass::other_vehicle, {0.2, 0.5}, random);
  add_wheels(mesh, frame, {-1, 1.15 - 0.5, 1.15, 0.85, 16}, machine_rubber);
  add_wheels(mesh, frame, {1.4, 1.05 - 0.4, 1.05, 0.6, 16}, machine_rubber);
  add_box(mesh, frame, {.low = {-1.4, -0.4, 0.6}, .high = {2.1, 0.4, 1.1}}, machine_steel);
  add_box(mesh, frame, {.low = {0.3, -0.42, 1}, .high = {2.2, 0.42, 1.65}}, body);
  add_box(mesh, frame, {.low = {-1.4, -0.75, 1}, .high = {0.3, 0.75, 1.6}}, body);
  add_box(mesh, frame, {.low = {-1.35, -0.7, 1.6}, .high = {0.25, 0.7, 2.65}}, machine_glass);
  add_box(mesh, frame, {.low = {-1.5, -0.8, 2.65}, .high = {0.4, 0.8, 2.8}}, body);
  if (shares == 0) return;
  constexpr double pitch = 0.9;  // between ploughshares, metres
  const double end = -1.8 - pitch * shares;
  add_arm(mesh, frame, {-1.4, 0, 0.8}, {end, -0.2 * shares, 0.9}, 0.1);
  for (int share = 0; share < shares; ++share) {
    const double x = -2.1 - pitch * share;
    const double y = -0.2 * share;
    add_box(mesh, frame, {.low = {x - 0.1, y - 0.05, 0.1}, .high = {x + 0.1, y + 0.05, 0.9}},
            machine_steel);
    add_box(mesh, frame, {.low = {x - 0.3, y - 0.3, -0.05}, .high = {x + 0.2, y, 0.35}},
            machine_steel);
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
    add_loft(mesh, track, std::array{at(-2, 0.3), at(-1.6, 0), at(1.6, 0), at(2, 0.3)},
             machine_rubber);
  }
  Frame upper = frame;
  upper.forward = std::cos(pose.swing) * frame.forward + std::sin(pose.swing) * frame.left;
  upper.left = cross(frame.up, upper.forward);
  add_cone(mesh, upper,
           {.from = {0, 0, 0.6}, .to = {0, 0, 1.1}, .radius_from = 0.7, .radius_to = 0.7},
           machine_steel);
  add_box(mesh, upper, {.low = {-2, -1.25, 1.05}, .high = {1, 1.25, 1.35}}, machine_steel);
  add_box(mesh, upper, {.low = {-2.2, -1.25, 1.35}, .high = {-0.6, 1.25, 2.2}}, machine_paint);
  add_box(mesh, upper, {.low = {-0.5, 0.3, 1.35}, .high = {1.1, 1.2, 2.9}}, machine_glass);
  constexpr double boom_length = 4.6;
  constexpr double stick_length = 2.7;
  const Vector3 foot{0.9, -0.3, 1.6};
  const Vector3 elbow = foot + boom_length * Vector3{std::cos(pose.boom), 0, std::sin(pose.boom)};
  const double bent = pose.boom - 1.7;
  const Vector3 wrist = elbow + stick_length * Vector3{std::cos(bent), 0, std::sin(bent)};
  add_arm(mesh, upper, foot, elbow, 0.28);
  add_arm(mesh, upper, elbow, wrist, 0.2);
  const Frame bucket{.origin = upper.to_world(wrist),
                     .forward = upper.forward,
                     .left = upper.left,
                     .up = upper.up};
  add_loft(mesh, bucket,
           std::array{Section{-0.7, -0.6, -0.3, 0.55, 0.55}, Section{-0.1, -0.9, 0.1, 0.55, 0.55},
                      Section{0.3, -0.5, 0, 0.55, 0.55}},
           machine_steel);
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Length of the longest car, metres, which parking spaces must fit.
inline constexpr double longest_car = 5.2;

/// Width of the widest car including its wheels, metres.
inline constexpr double widest_car = 1.97;

/// A car of a random kind (hatchback, saloon, estate, van) and paint: body with bonnet, cabin with
/// windows that return almost no light, wheels. Beams can pass under it. `frame` is on the ground
/// below its middle.
void add_car(Mesh& mesh, const Frame& frame, Random& random);

/// Length and width of every bus, metres.
inline constexpr double bus_length = 12;
inline constexpr double bus_width = 2.5;

/// A low-floor city bus: body, a band of windows, wheels. `frame` is on the ground below its
/// middle.
void add_bus(Mesh& mesh, const Frame& frame, Random& random);

/// Length and width of every truck, metres.
inline constexpr double truck_length = 15.6;
inline constexpr double truck_width = 2.5;

/// A tractor with a semi-trailer (box, tank or flatbed with a load). Beams can pass under it.
/// `frame` is on the ground below its middle.
void add_truck(Mesh& mesh, const Frame& frame, Random& random);

/// Length (including the fork) and width of every forklift, metres.
inline constexpr double forklift_length = 3.4;
inline constexpr double forklift_width = 1.2;

/// A forklift truck with mast, overhead guard and driver, its fork just above the floor, with or
/// without a load. `frame` is on the ground below its middle.
void add_forklift(Mesh& mesh, const Frame& frame, Random& random);

/// A tractor (class other_vehicle), 4.4 m long, 2.3 m wide, with a plough of `shares` ploughshares;
/// 0 for none. `frame` is on the ground below its middle, x forward.
void add_tractor(Mesh& mesh, const Frame& frame, int shares, Random& random);

/// Pose of an excavator, radians.
struct ExcavatorPose {
  double swing = 0;   ///< of cabin and arm relative to the tracks, counter-clockwise
  double boom = 0.7;  ///< angle of the boom above the horizontal
};

/// A tracked excavator (class other_vehicle): tracks of 4 m by 2.8 m, an arm that reaches up to 7 m
/// from its middle. `frame` is on the ground below its middle, tracks along x.
void add_excavator(Mesh& mesh, const Frame& frame, const ExcavatorPose& pose);

/// Maximum reach of an excavator from its middle, metres.
inline constexpr double excavator_reach = 7;

}  // namespace flagstone::sim

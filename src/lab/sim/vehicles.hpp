// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// The longest car there is, metres: what a parking place has to hold.
inline constexpr double longest_car = 5.2;

/// The widest, metres, with its wheels.
inline constexpr double widest_car = 1.97;

/// A car of a random kind (hatchback, saloon, estate, van) and paint: body with bonnet, cabin with
/// windows that reflect nearly nothing, wheels; hollow below, so that beams pass under it. `frame`
/// stands on the ground below its middle.
void add_car(Mesh& mesh, const Frame& frame, Random& random);

/// Length and width of every bus, metres.
inline constexpr double bus_length = 12;
inline constexpr double bus_width = 2.5;

/// A low-floor city bus: body, a belt of windows, wheels. `frame` stands on the ground below its
/// middle.
void add_bus(Mesh& mesh, const Frame& frame, Random& random);

/// Length and width of every truck, metres.
inline constexpr double truck_length = 15.6;
inline constexpr double truck_width = 2.5;

/// A tractor with a semi-trailer (box, tank or flatbed with a load), hollow below. `frame` stands
/// on the ground below its middle.
void add_truck(Mesh& mesh, const Frame& frame, Random& random);

/// Length with the fork and width of every forklift, metres.
inline constexpr double forklift_length = 3.4;
inline constexpr double forklift_width = 1.2;

/// A forklift truck with mast, overhead guard and driver, its fork just above the floor, with or
/// without a load. `frame` stands on the ground below its middle.
void add_forklift(Mesh& mesh, const Frame& frame, Random& random);

/// A tractor (class other_vehicle), 4.4 m long, 2.3 m wide, with a plough of `shares` behind; 0 for
/// none. `frame` stands on the ground below its middle and looks ahead.
void add_tractor(Mesh& mesh, const Frame& frame, int shares, Random& random);

/// How an excavator holds itself, radians.
struct ExcavatorPose {
  double swing = 0;   ///< of cabin and arm on the tracks, counter-clockwise
  double boom = 0.7;  ///< of the boom above the horizontal
};

/// A tracked excavator (class other_vehicle): tracks 4 m by 2.8 m, an arm that reaches up to 7 m
/// from its middle. `frame` stands on the ground below its middle, tracks along x.
void add_excavator(Mesh& mesh, const Frame& frame, const ExcavatorPose& pose);

/// How far from its middle nothing of an excavator reaches, metres.
inline constexpr double excavator_reach = 7;

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

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

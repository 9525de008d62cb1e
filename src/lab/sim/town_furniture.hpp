// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// What stands on the sidewalks of a town. Every frame stands on the ground.

/// A shelter 4 m long and 1.4 m deep with panes that mirror beams, a roof and a bench; open along
/// the frame's x axis.
void add_bus_shelter(Mesh& mesh, const Frame& frame);

/// 1.6 m long along y.
void add_bench(Mesh& mesh, const Frame& frame);

void add_bin(Mesh& mesh, const Frame& frame);

/// A post 0.9 m high.
void add_bollard(Mesh& mesh, const Frame& frame);

/// A pole of 3.4 m with a head that looks along x; `arm` metres to the left, if not 0, another head
/// hangs 5.5 m high.
void add_traffic_light(Mesh& mesh, const Frame& frame, double arm);

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/extrusion.hpp"
#include "lab/sim/interval.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// Barriers along a road at `t` metres to its left, from x.low to x.high; the road's level is the
/// ground's, so that they follow it.

/// A steel beam 45 to 76 cm high on posts 4 m apart.
void add_guard_rail(Mesh& mesh, double t, Interval x, const RoadPlace& place);

/// A concrete wall 0.9 m high that is broader at its foot.
void add_concrete_barrier(Mesh& mesh, double t, Interval x, const RoadPlace& place);

/// Panels between posts 5 m apart, `height` metres high.
void add_noise_barrier(Mesh& mesh, double t, double height, Interval x, const RoadPlace& place);

}  // namespace flagstone::sim

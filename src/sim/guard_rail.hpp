// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ground.hpp"
#include "sim/mesh.hpp"

namespace flagstone::sim {

/// A steel rail on posts, its upper edge 75 cm high (class fence, as annotators colour crash
/// barriers), along the straight line from (x0, y0) to (x1, y1), metres.
struct GuardRail {
  double x0, y0, x1, y1;
};
void add_guard_rail(Mesh& mesh, const Ground& ground, const GuardRail& rail);

/// A delineator post at the edge of a road, 1 m high (class pole).
void add_delineator(Mesh& mesh, const Ground& ground, double x, double y);

}  // namespace flagstone::sim

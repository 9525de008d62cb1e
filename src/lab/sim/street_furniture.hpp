// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// A lamp post (class pole), 6 m high, its arm along the frame's x axis. `frame` stands on the
/// ground.
void add_lamp_post(Mesh& mesh, const Frame& frame);

/// A traffic sign on its own pole; the plate faces along the frame's x axis. `frame` stands on the
/// ground.
void add_traffic_sign(Mesh& mesh, const Frame& frame);

/// A delineator at the edge of a road, 1 m high (class pole). `frame` stands on the ground.
void add_delineator(Mesh& mesh, const Frame& frame);

/// A fence of upright boards with gaps between, that follows the ground along the straight line
/// from (x0, y0) to (x1, y1), metres.
struct Fence {
  double x0, y0, x1, y1;
  double height = 1.1;
};
void add_fence(Mesh& mesh, const Ground& ground, const Fence& fence);

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// A lamp post (class pole), 6 m high, its arm along the x axis of the frame. `frame` is on the
/// ground.
void add_lamp_post(Mesh& mesh, const Frame& frame);

/// A traffic sign on its own pole; the plate faces along the x axis of the frame. `frame` is on the
/// ground.
void add_traffic_sign(Mesh& mesh, const Frame& frame);

/// A delineator at the edge of a road, 1 m high (class pole). `frame` is on the ground.
void add_delineator(Mesh& mesh, const Frame& frame);

/// A fence of upright boards with gaps, along the ground on the straight line from (x0, y0) to (x1,
/// y1), metres.
struct Fence {
  double x0, y0, x1, y1;
  double height = 1.1;
};
void add_fence(Mesh& mesh, const Ground& ground, const Fence& fence);

/// Objects on the sidewalks of a town. Every frame is on the ground.

/// A shelter, 4 m long and 1.4 m deep, with reflective panes, a roof and a bench; open along the x
/// axis of the frame.
void add_bus_shelter(Mesh& mesh, const Frame& frame);

/// A bench, 1.6 m long along y.
void add_bench(Mesh& mesh, const Frame& frame);

void add_bin(Mesh& mesh, const Frame& frame);

/// A post 0.9 m high.
void add_bollard(Mesh& mesh, const Frame& frame);

/// A pole of 3.4 m with a head that faces along x. If `arm` is not 0, another head is `arm` metres
/// to the left, 5.5 m high.
void add_traffic_light(Mesh& mesh, const Frame& frame, double arm);

/// Barriers along a road, `t` metres to its left, from x.low to x.high. They follow the ground,
/// which is the level of the road.

/// A steel beam 45 to 76 cm high on posts 4 m apart.
void add_guard_rail(Mesh& mesh, double t, Interval x, const RoadPlace& place);

/// A concrete wall 0.9 m high that is wider at its base.
void add_concrete_barrier(Mesh& mesh, double t, Interval x, const RoadPlace& place);

/// Panels between posts 5 m apart, `height` metres high.
void add_noise_barrier(Mesh& mesh, double t, double height, Interval x, const RoadPlace& place);

}  // namespace flagstone::sim

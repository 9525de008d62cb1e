// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lab/sim/frame.hpp"
#include "lab/sim/ground.hpp"

namespace flagstone::sim {

/// Where the ground truly is at each point of a scan, so that the point stands z - ground metres
/// above it along `up`, the vehicle's z axis in the world, of length 1. For a sensor that is
/// mounted upright that is the z of the ground on the line through the point along the sensor's own
/// z axis. `xyzi` holds 4 floats a point as SimulatedScan does.
///
/// The line leans with the vehicle, so that it may meet a steep face more than once: what counts is
/// the first ground on the way down from a point above the ground, or up from one below. NaN where
/// the ground does not cover the point or the way, and for (0, 0, 0), which is no echo at all.
std::vector<float> true_ground(const Ground& ground, const Frame& pose, Vector3 up,
                               std::span<const float> xyzi);

/// The same for a sensor that is mounted upright.
std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi);

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/frame.hpp"
#include "sim/ground.hpp"

namespace flagstone::sim {

/// Where the ground truly is at each point of a scan: the z of the ground on the line through the
/// point along the sensor's z axis, metres, sensor frame, so that the point stands z - ground high.
/// `xyzi` holds 4 floats a point as SimulatedScan does.
///
/// The line leans with the sensor, so that it may meet a steep face more than once: what counts is
/// the first ground on the way down from a point above the ground, or up from one below. NaN where
/// the ground does not cover the point or the way.
std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi);

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lab/sim/ground.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {

inline Ground flat_ground() {
  constexpr double half = 250;  // metres
  constexpr Surface road{.semantic = SemanticClass::road, .reflectivity = 0.3F};
  return {{.x = {-half, half}, .offset = {0, 0}, .t = {-half, half}}, {0, 0, 0, 0}, {road}};
}

/// Objects on a level road, z = 0.
inline Scene flat_scene(Mesh objects = {}) { return {flat_ground(), std::move(objects)}; }

/// A quad across the x axis, 40 m wide, from z = -1 to 20 m.
inline void add_wall(Mesh& mesh, double x, Surface surface) {
  mesh.add_quad({x, -20, -1}, {x, 20, -1}, {x, 20, 20}, {x, -20, 20}, surface);
}

/// A level frame, `height` metres above the origin.
inline Frame above_origin(double height) { return {.origin = {0, 0, height}}; }

inline Vector3 point_of(const SimulatedScan& scan, std::size_t i) {
  return {scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]};
}

inline SemanticClass class_of(const SimulatedScan& scan, std::size_t i) {
  return static_cast<SemanticClass>(scan.classes[i]);
}

inline double count(const SimulatedScan& scan, EchoKind kind) {
  return static_cast<double>(std::ranges::count(scan.echoes, kind));
}

/// A sensor with `rows` times `firings` beams in a narrow field of view ahead.
inline Sensor sensor_ahead(int rows, int firings) {
  Sensor sensor{.name = "ahead",
                .title = "",
                .elevations = {},
                .firings = firings,
                .azimuth_begin = -3,
                .azimuth_end = 3,
                .min_range = 0.5,
                .max_range = 100,
                .range_sigma = 0.02,
                .height = 1.5};
  for (int row = 0; row < rows; ++row) sensor.elevations.push_back(4 - 4.0 * row / rows);
  return sensor;
}

}  // namespace flagstone::sim

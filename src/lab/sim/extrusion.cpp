// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/extrusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flagstone::sim {
namespace {

void close_end(Mesh& mesh, std::span<const Vector3> corners, Surface surface) {
  for (std::size_t i = 1; i + 2 < corners.size(); ++i) {
    mesh.add_triangle(corners[0], corners[i], corners[i + 1], surface);
  }
}

}  // namespace

void add_extrusion(Mesh& mesh, std::span<const OutlinePoint> outline, Interval x, double step,
                   const RoadPlace& place, Surface surface) {
  const auto corners_at = [&](double at) {
    std::vector<Vector3> corners;
    for (const OutlinePoint& point : outline) corners.push_back(place(at, point.t, point.z));
    return corners;
  };
  const OutlinePoint first = outline.front();
  const OutlinePoint last = outline.back();
  const bool encloses = first.t == last.t && first.z == last.z;
  const int pieces = std::max(1, static_cast<int>(std::ceil((x.high - x.low) / step - 1e-9)));
  std::vector<Vector3> behind = corners_at(x.low);
  if (encloses) close_end(mesh, behind, surface);
  for (int piece = 1; piece <= pieces; ++piece) {
    const std::vector<Vector3> ahead = corners_at(x.low + (x.high - x.low) * piece / pieces);
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      mesh.add_quad(behind[i], behind[i + 1], ahead[i + 1], ahead[i], surface);
    }
    behind = ahead;
  }
  if (encloses) close_end(mesh, behind, surface);
}

void add_beam(Mesh& mesh, const BeamSection& section, Interval x, double step,
              const RoadPlace& place, Surface surface) {
  const auto& [t, z] = section;
  add_extrusion(mesh,
                std::array{OutlinePoint{t.low, z.low}, OutlinePoint{t.high, z.low},
                           OutlinePoint{t.high, z.high}, OutlinePoint{t.low, z.high},
                           OutlinePoint{t.low, z.low}},
                x, step, place, surface);
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/height_map.hpp"

#include <cmath>

namespace flagstone::render {
namespace {

template <class HeightAt>
HeightMap map_by(double extent, double cell, HeightAt height_at) {
  constexpr double rounding = 1e-6;  // cells; an extent of whole cells must not get one more
  HeightMap map{.cell = cell,
                .width = 2 * static_cast<std::size_t>(std::ceil(extent / cell - rounding)),
                .heights = {}};
  map.heights.resize(map.width * map.width);
  auto* to = map.heights.data();
  for (std::size_t row = 0; row < map.width; ++row) {
    const auto y = static_cast<float>(map.y(static_cast<double>(row)));
    for (std::size_t column = 0; column < map.width; ++column) {
      *to++ = height_at(static_cast<float>(map.x(static_cast<double>(column))), y);
    }
  }
  return map;
}

}  // namespace

HeightMap map_of(const GroundSurface& surface, double extent, double cell) {
  return map_by(extent, cell, [&](float x, float y) { return surface.height(x, y); });
}

HeightMap smoothed_map_of(const GroundSurface& surface, double extent, double cell) {
  return map_by(extent, cell, [&](float x, float y) {
    const float half = surface.resolution(x, y) / 2;
    return (surface.height(x - half, y - half) + surface.height(x + half, y - half) +
            surface.height(x - half, y + half) + surface.height(x + half, y + half)) /
           4;
  });
}

}  // namespace flagstone::render

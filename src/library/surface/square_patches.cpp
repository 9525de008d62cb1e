// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/square_patches.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace flagstone::surface {
namespace {

/// However high the sensor, farther away it sees the ground, metres.
constexpr float most_blind_range = 6;

}  // namespace

SquarePatches::SquarePatches(const SurfaceConfig& config, const SquareCells& cells) {
  const int blocks = 2 * cells.half_blocks();
  const float blind_range = std::min(2 * std::abs(config.sensor_height), most_blind_range);
  const auto add = [&](CellRange range, int row, int column, int size) {
    const auto side = static_cast<float>(size);
    const SquarePatch patch{.cells = range,
                            .x = (static_cast<float>(column) + 0.5f) * side - cells.extent(),
                            .y = (static_cast<float>(row) + 0.5f) * side - cells.extent(),
                            .size = side,
                            .size_class = static_cast<std::uint16_t>(size == block_size ? 1 : 0),
                            .row = static_cast<std::uint16_t>(row),
                            .column = static_cast<std::uint16_t>(column)};
    if (std::hypot(patch.x, patch.y) >= blind_range) list_.push_back(patch);
  };
  for (int row = 0; row < blocks; ++row) {
    for (int column = 0; column < blocks; ++column) {
      const CellRange block = cells.block(column, row);
      if (cells.block_class(column, row) > 1) {
        add(block, row, column, block_size);
        continue;
      }
      const std::uint32_t quarter = (block.last - block.first) / 4;  // along the Z-order curve
      for (std::uint32_t i = 0; i < 4; ++i) {
        add({block.first + i * quarter, block.first + (i + 1) * quarter},
            2 * row + static_cast<int>(i / 2), 2 * column + static_cast<int>(i % 2),
            block_size / 2);
      }
    }
  }
  std::ranges::sort(list_, {}, [](const SquarePatch& patch) {
    return std::tuple(patch.x * patch.x + patch.y * patch.y, patch.row, patch.column);
  });
}

}  // namespace flagstone::surface

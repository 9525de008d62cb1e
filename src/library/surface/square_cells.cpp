// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/square_cells.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "library/core/mounting_height.hpp"

namespace flagstone::surface {
namespace {

/// Beyond this range the sensor sees the ground at any sensor height, metres.
constexpr float most_blind_range = 6;

/// Ring class of each level. The classes end 8, 24 and 40 m from the sensor and at the edge.
constexpr std::array<int, level_count> class_of_level = {3, 2, 1, 0};

/// Number of blocks from the sensor to the end of the class.
int class_reach(int ring_class, int half_blocks) {
  for (std::size_t level = 0; level < level_count; ++level) {
    if (class_of_level[level] != ring_class) continue;
    return std::min(static_cast<int>(levels[level].reach) / block_size, half_blocks);
  }
  return half_blocks;
}

int class_of_ring(int ring, int half_blocks) {
  int ring_class = 0;
  while (ring_class < 3 && ring >= class_reach(ring_class, half_blocks)) ++ring_class;
  return ring_class;
}

/// Coordinates up to this fraction of the extent stay inside the cells although the distance to the
/// edge is rounded. This matters only if the range ends at the edge of a block.
constexpr float last_inside = 1 - 1.0f / (1 << 22);

/// Step of SquareCells::packed_zero(), metres.
constexpr float packed_step = 32;

float squared(float value) { return value * value; }

/// Cells along one side of a block: 32, 16, 8, 4.
constexpr int cells_along(int ring_class) { return 32 >> ring_class; }

}  // namespace

SquareCells::SquareCells(const SurfaceConfig& config)
    : half_blocks_(static_cast<int>(std::ceil(config.max_range / block_size))),
      max_squared_range_(squared(std::min(config.max_range, last_inside * extent()))),
      noise_height_(-config.sensor_height - config.noise_depth),
      noise_slope_(config.noise_slope),
      packed_zero_(packed_step * std::nearbyint(-config.sensor_height / packed_step)) {
  std::array<std::uint32_t, level_count> bases{};
  for (int ring_class = 0; ring_class < 4; ++ring_class) {
    const auto width = static_cast<std::uint32_t>(2 * class_reach(ring_class, half_blocks_));
    const auto along = static_cast<std::uint32_t>(cells_along(ring_class));
    bases[static_cast<std::size_t>(ring_class)] = cell_count_;
    cell_count_ += width * width * along * along;
  }
  for (std::size_t ring = 0; ring < 8; ++ring) {
    const int ring_class = class_of_ring(static_cast<int>(ring), half_blocks_);
    const int reach = class_reach(ring_class, half_blocks_);
    const int inside = half_blocks_ - reach;  // blocks between the edge of the class and the extent
    const int cells = cells_along(ring_class) * cells_along(ring_class);
    const int row_cells = 2 * reach * cells;
    class_strides_[ring] = cells | row_cells << 16;
    class_bases_[ring] = static_cast<int>(bases[static_cast<std::size_t>(ring_class)]) -
                         inside * (cells + row_cells);
    class_shifts_[ring] = 2 * ring_class;
  }
  for (int row = 0; row < 2 * half_blocks_; ++row) {
    for (int column = 0; column < 2 * half_blocks_; ++column) {
      blocks_.push_back(block(column, row));
    }
  }
}

int SquareCells::block_class(int column, int row) const noexcept {
  const auto ring = [&](int index) {
    return index < half_blocks_ ? half_blocks_ - 1 - index : index - half_blocks_;
  };
  return class_of_ring(std::max(ring(column), ring(row)), half_blocks_);
}

CellRange SquareCells::block(int column, int row) const noexcept {
  const auto distance = [&](int index) {
    return index < half_blocks_ ? half_blocks_ - 1 - index : index - half_blocks_;
  };
  const auto ring =
      static_cast<std::size_t>(std::min(std::max(distance(column), distance(row)), 7));
  const std::int32_t cells = class_strides_[ring] & 0xFFFF;
  const std::int32_t row_cells = class_strides_[ring] >> 16;
  const auto first =
      static_cast<std::uint32_t>(class_bases_[ring] + column * cells + row * row_cells);
  return {first, first + static_cast<std::uint32_t>(cells)};
}

SquarePatches::SquarePatches(const SurfaceConfig& config, const SquareCells& cells) {
  const int blocks = 2 * cells.half_blocks();
  const float blind_range = std::min(2 * mounting_height(config.sensor_height), most_blind_range);
  const auto add = [&](CellRange range, CellRange coarse, int row, int column, int size) {
    const auto side = static_cast<float>(size);
    const SquarePatch patch{.cells = range,
                            .coarse = coarse,
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
      const auto coarse = coarse_cells_of_block * static_cast<std::uint32_t>(row * blocks + column);
      if (cells.block_class(column, row) > 1) {
        add(block, {coarse, coarse + coarse_cells_of_block}, row, column, block_size);
        continue;
      }
      const std::uint32_t quarter = (block.last - block.first) / 4;  // along the Z-order curve
      for (std::uint32_t i = 0; i < 4; ++i) {
        add({block.first + i * quarter, block.first + (i + 1) * quarter},
            {coarse + 4 * i, coarse + 4 * (i + 1)}, 2 * row + static_cast<int>(i / 2),
            2 * column + static_cast<int>(i % 2), block_size / 2);
      }
    }
  }
  std::ranges::sort(list_, {}, [](const SquarePatch& patch) {
    return std::tuple(patch.x * patch.x + patch.y * patch.y, patch.row, patch.column);
  });
}

}  // namespace flagstone::surface

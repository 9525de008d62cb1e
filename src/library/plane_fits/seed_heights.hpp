// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "library/core/buffer.hpp"
#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::plane_fits {

/// z-bar_init of eq. (5) for the bins of a batch.
class SeedHeights {
 public:
  /// Reserves memory for bins with up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) { heights_.reserve(points + 32); }

  /// Computes for each bin the mean height of its `counts[i]` lowest points (N_seed, at least 1)
  /// that are not below `floors[i]`, or `height_without_seeds` if there are none. Metres. Heights
  /// are added from the lowest upwards, so that the sum does not depend on the order of the points.
  void find(const BinBatch& batch, const std::array<float, batch_size>& floors,
            const std::array<std::uint32_t, batch_size>& counts, Batch& means,
            double height_without_seeds = 0) noexcept;

 private:
  Buffer<float> heights_;
};

}  // namespace flagstone::plane_fits

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::plane_fits {

/// The points G of a bin with bottom <= n . p < top, metres: eq. (6) with p as the batch
/// has it and n = (normal_x, normal_y, normal_z). With n = (0, 0, 1) a set of eq. (5).
struct GroundSet {
  float normal_x, normal_y, normal_z;
  float bottom, top;
};

/// One for each bin of a batch.
using GroundSets = std::array<GroundSet, batch_size>;

/// Bins of a batch, bit i for bin i.
using BinMask = std::uint32_t;

/// Precision of sums over points; the sets are the same in both.
enum class Precision : std::uint8_t {
  /// Sums of at most 64 numbers a lane in single precision, sums of these in double: errors of up
  /// to 4e-6 of the sum of the squares, and mostly a tenth of that.
  single,
  /// All in double.
  full,
};

/// Moments of the sets of the bins in `wanted`; those of other bins are left alone.
void sum_moments(const BinBatch& batch, const GroundSets& sets, BinMask wanted, Precision precision,
                 MomentsBatch& moments) noexcept;

/// Where the first set of a bin begins, metres.
struct FirstSet {
  float origin;       ///< where heights are seen from afterwards
  float bottom, top;  ///< of the set, seen from there: bottom <= z < top, eq. (5)
};

/// Moves the origin of z in every bin of the batch, and takes the moments of the first sets on the
/// way, in single precision.
void sum_first_moments(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                       MomentsBatch& moments) noexcept;

}  // namespace flagstone::plane_fits

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::plane_fits {

/// The points G of a bin with bottom <= n . p < top, metres: eq. (6) with the packed coordinates p
/// and n = (normal_x, normal_y, normal_z). With n = (0, 0, 1) it is a set of eq. (5).
struct GroundSet {
  float normal_x, normal_y, normal_z;
  float bottom, top;
};

/// One ground set per bin of a batch.
using GroundSets = std::array<GroundSet, batch_size>;

/// Bins of a batch: bit i is bin i.
using BinMask = std::uint32_t;

/// Precision of sums over points. It does not change the sets.
enum class Precision : std::uint8_t {
  /// Sums of at most 64 numbers per lane in single precision, and of these sums in double
  /// precision.
  /// The error is at most 4e-6 of the sum of the squares, and usually a tenth of that.
  single,
  /// All sums in double precision.
  full,
};

/// Computes the moments of the sets of the bins in `wanted`. The moments of other bins do not
/// change.
void sum_moments(const BinBatch& batch, const GroundSets& sets, BinMask wanted, Precision precision,
                 MomentsBatch& moments) noexcept;

/// The first set of a bin and the new origin of its heights, metres.
struct FirstSet {
  float origin;       ///< subtracted from all heights of the bin
  float bottom, top;  ///< the set, relative to `origin`: bottom <= z < top, eq. (5)
};

/// Subtracts the origin from z in every bin of the batch and computes the moments of the first sets
/// in the same pass, in single precision.
void sum_first_moments(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                       MomentsBatch& moments) noexcept;

}  // namespace flagstone::plane_fits

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
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

/// Coordinates for which sums over the squares of 8 points are exact in single precision: x and y
/// are multiples of 1/128 m up to 4 m, and z is a multiple of 1/256 m up to 4 m.
struct ExactGrid {
  static constexpr float xy_step = 1.0f / 128;
  static constexpr float z_step = 1.0f / 256;
  static constexpr float reach = 4;
  static constexpr std::size_t most_points = 128;
};

/// Precision of sums over points. It does not change the sets.
enum class Precision : std::uint8_t {
  /// Sums of at most 64 numbers per lane in single precision, and of these sums in double
  /// precision.
  /// The error is at most 4e-6 of the sum of the squares, and usually a tenth of that.
  single,
  /// All sums in double precision.
  full,
  /// Sums of at most 8 numbers per lane in single precision, and of these sums in double precision.
  /// Exact, and so independent of the order of the points, for up to 128 points on the grid of
  /// ExactGrid.
  exact,
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
/// in the same pass, with Precision::single or Precision::exact. For exact sums, points farther
/// than the reach of ExactGrid above or below the origin become infinitely high.
void sum_first_moments(BinBatch& batch, const std::array<FirstSet, batch_size>& sets,
                       Precision precision, MomentsBatch& moments) noexcept;

}  // namespace flagstone::plane_fits

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace flagstone::surface {

/// Corrections of a square grid, by cell, row by row.
struct Corrections {
  float* values;   ///< metres
  float* weights;  ///< 0 for cells without a correction
  std::size_t width;
};

/// A correction of one cell that is not yet part of the grid.
struct Candidate {
  std::uint32_t place;  ///< row * width + column
  float correction;     ///< metres
  float weight;         ///< 0: no correction
};

/// Adds candidates to the corrections.
void accept(std::span<const Candidate> candidates, const Corrections& corrections) noexcept;

/// Adds candidates that their neighbours confirm. At least one of the eight cells around must have
/// a similar correction, and at least as many a similar one as a much lower one. A confirmed
/// candidate can then confirm a neighbour, once. Reorders `candidates`.
void accept_confirmed(std::span<Candidate> candidates, const Corrections& corrections) noexcept;

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::surface {

/// How many of a patch's points lie in its plane and just above it.
struct SlabCounts {
  std::uint32_t within;  ///< less than 12.5 cm from the plane
  std::uint32_t above;   ///< more than 18.75 and less than 88.75 cm above it
};

/// For each patch of a batch the points in and above a plane n . p + d = 0, p as the batch has it.
std::array<SlabCounts, batch_size> count_slabs(const plane_fits::BinBatch& batch,
                                               const PlaneBatch& planes) noexcept;

}  // namespace flagstone::surface

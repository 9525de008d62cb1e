// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"

namespace flagstone::bench {

/// Read-only baseline: a lower bound for the time of any segmentation. Reads x, y and z of every
/// point and writes one byte per point: 1 if z is above both x and y, otherwise 0.
///
/// `bytes` must have cloud.size() elements. Packed points of 3 or 4 floats are processed with the
/// active instruction set (core/simd_target.hpp), other layouts with plain C++. The result is the
/// same.
void read_baseline(CloudView cloud, std::span<std::uint8_t> bytes) noexcept;

}  // namespace flagstone::bench

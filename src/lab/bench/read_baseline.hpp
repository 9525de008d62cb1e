// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"

namespace flagstone::bench {

/// What no segmentation can do without, and so the floor under its time: reads x, y and z of every
/// point and writes one byte a point, 1 where z is above both x and y, else 0.
///
/// `bytes` holds cloud.size() of them. Works with the instruction set in use (core/simd_target.hpp)
/// where x, y and z lie packed, 3 or 4 floats a point, else in plain C++; the bytes are the same.
void read_baseline(CloudView cloud, std::span<std::uint8_t> bytes) noexcept;

}  // namespace flagstone::bench

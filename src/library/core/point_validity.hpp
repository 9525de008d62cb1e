// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "flagstone/cloud_view.hpp"

namespace flagstone {

/// Points with a coordinate beyond this are out of range, metres. `surface` and `patchwork` use
/// their own smaller limits for x and y.
inline constexpr float max_coordinate = 10000;

/// True if no coordinate is NaN or infinite.
inline bool is_finite(const Point& p) noexcept {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// True for the all-zero point that drivers write for a missing return. Denormals are not zero
/// here, in any floating-point mode.
inline bool is_missing_return(const Point& p) noexcept {
  const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v) << 1; };  // no sign
  return (bits(p.x) | bits(p.y) | bits(p.z)) == 0;
}

/// True unless the point gets the label `invalid`. simd/lanes-inl.hpp has the vector version.
inline bool is_valid(const Point& p) noexcept { return is_finite(p) && !is_missing_return(p); }

/// True if no coordinate is beyond max_coordinate. Other valid points get the label `out_of_range`.
inline bool is_within_limit(const Point& p) noexcept {
  return std::abs(p.x) <= max_coordinate && std::abs(p.y) <= max_coordinate &&
         std::abs(p.z) <= max_coordinate;
}

}  // namespace flagstone

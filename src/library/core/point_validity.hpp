// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "flagstone/cloud_view.hpp"

namespace flagstone {

/// Coordinates farther from the origin than this are not measurements: the point is out of range.
/// Metres. `surface` and `patchwork` limit x and y by their own, smaller range.
inline constexpr float max_coordinate = 10000;

/// Is no coordinate NaN or infinite?
inline bool is_finite(const Point& p) noexcept {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Is this the all-zero point that drivers write for a missing return? Denormals are not zero, in
/// any floating-point mode.
inline bool is_missing_return(const Point& p) noexcept {
  const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v) << 1; };  // no sign
  return (bits(p.x) | bits(p.y) | bits(p.z)) == 0;
}

/// A point that is not valid has the label `invalid`. See is_valid in simd/lanes-inl.hpp, too.
inline bool is_valid(const Point& p) noexcept { return is_finite(p) && !is_missing_return(p); }

/// Is no coordinate beyond max_coordinate? A valid point that is has the label `out_of_range`.
inline bool is_within_limit(const Point& p) noexcept {
  return std::abs(p.x) <= max_coordinate && std::abs(p.y) <= max_coordinate &&
         std::abs(p.z) <= max_coordinate;
}

}  // namespace flagstone

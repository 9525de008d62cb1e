// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace flagstone {

/// 1 / n! for n from 0 to 15.
inline constexpr auto inverse_factorials = [] {
  std::array<double, 16> inverse{};
  double factorial = 1;
  for (std::size_t n = 0; n < inverse.size(); ++n) {
    factorial *= n > 0 ? static_cast<double>(n) : 1.0;
    inverse[n] = 1 / factorial;
  }
  return inverse;
}();

/// e^x with a relative error below 1e-15. Uses only + and *, because the bits of exp() in a
/// mathematical library depend on the CPU. x is clamped to -700 to 700, so that the result is never
/// 0 or infinity.
inline double exponential(double x) noexcept {
  x = std::clamp(x, -700.0, 700.0);
  // x = k ln 2 + rest. ln 2 is split in two parts, so that k times the first part is exact.
  const double turns = x * 1.4426950408889634;
  const auto k = static_cast<std::int64_t>(turns < 0 ? turns - 0.5 : turns + 0.5);
  const auto steps = static_cast<double>(k);
  const double rest = (x - steps * 0.693147180369123816490) - steps * 1.90821492927058770002e-10;
  // Taylor series, grouped in pairs of pairs, so that the terms can be computed in parallel.
  const auto& c = inverse_factorials;
  const double rest2 = rest * rest;
  const double rest4 = rest2 * rest2;
  const auto four = [&](std::size_t n) {
    return (c[n] + c[n + 1] * rest) + (c[n + 2] + c[n + 3] * rest) * rest2;
  };
  const double sum = (four(0) + four(4) * rest4) + (four(8) + four(12) * rest4) * (rest4 * rest4);
  return sum * std::bit_cast<double>((k + 1023) << 52);
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace flagstone {

/// 1 / n! for n from 0 to 13.
inline constexpr auto inverse_factorials = [] {
  std::array<double, 14> inverse{};
  double factorial = 1;
  for (std::size_t n = 0; n < inverse.size(); ++n) {
    factorial *= n > 0 ? static_cast<double>(n) : 1.0;
    inverse[n] = 1 / factorial;
  }
  return inverse;
}();

/// e^x within 1e-15 of it, by + and * alone: the bits of a mathematics library's exp() depend on the
/// processor it finds. Beyond -700 and 700 it stays what it is there, short of 0 and infinity.
inline double exponential(double x) noexcept {
  x = std::clamp(x, -700.0, 700.0);
  // x = k ln 2 + rest; ln 2 in two parts, so that k times the first is exact.
  const double turns = x * 1.4426950408889634;
  const auto k = static_cast<std::int64_t>(turns < 0 ? turns - 0.5 : turns + 0.5);
  const auto steps = static_cast<double>(k);
  const double rest = (x - steps * 0.693147180369123816490) - steps * 1.90821492927058770002e-10;
  double sum = inverse_factorials.back();  // Taylor's series
  for (auto term = inverse_factorials.rbegin() + 1; term != inverse_factorials.rend(); ++term) {
    sum = sum * rest + *term;
  }
  return sum * std::bit_cast<double>((k + 1023) << 52);
}

}  // namespace flagstone

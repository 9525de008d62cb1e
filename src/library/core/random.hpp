// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace flagstone {

/// Random numbers that do not depend on the standard library, unlike the std:: distributions.
/// SplitMix64: G. L. Steele, D. Lea, C. H. Flood, "Fast Splittable Pseudorandom Number Generators",
/// OOPSLA 2014.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  /// A separate stream for item `index` (a ray, a house). The numbers drawn for one item do not
  /// depend on how many are drawn for other items, or in which order.
  static constexpr Random stream(std::uint64_t seed, std::uint64_t index) noexcept {
    return Random(mix(mix(seed + increment) ^ (index * increment)));
  }

  constexpr std::uint64_t bits() noexcept {
    state_ += increment;
    return mix(state_);
  }

  /// Uniform in [0, 1).
  constexpr double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }

  /// True with this probability.
  constexpr bool chance(double probability) noexcept { return uniform() < probability; }

  /// Approximately normal with mean 0 and standard deviation 1, within +-6: the sum of twelve
  /// uniform numbers. Uses no logarithm or cosine, whose last bit differs between mathematical
  /// libraries.
  constexpr double normal() noexcept {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  static constexpr std::uint64_t increment = 0x9e3779b97f4a7c15;

  static constexpr std::uint64_t mix(std::uint64_t z) noexcept {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

}  // namespace flagstone

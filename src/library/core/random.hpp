// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace flagstone {

/// Random numbers that are the same with every standard library, which std:: distributions are not.
/// SplitMix64: G. L. Steele, D. Lea, C. H. Flood, "Fast Splittable Pseudorandom Number Generators",
/// OOPSLA 2014.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed) {}

  /// A stream of its own for item `index` (a ray, a house): what is drawn for one item does not
  /// depend on how many are drawn for the others, nor on the order.
  static constexpr Random stream(std::uint64_t seed, std::uint64_t index) noexcept {
    return Random(mix(mix(seed + increment) ^ (index * increment)));
  }

  constexpr std::uint64_t bits() noexcept {
    state_ += increment;
    return mix(state_);
  }

  /// In [0, 1).
  constexpr double uniform() noexcept { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// In [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }

  /// True with this probability.
  constexpr bool chance(double probability) noexcept { return uniform() < probability; }

  /// Mean 0, standard deviation 1, never beyond +-6: the sum of twelve uniforms. Needs no logarithm
  /// or cosine, whose last bit differs between mathematical libraries.
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The methods of the library, for tests that apply to all of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "library/core/simd_target.hpp"
#include "outcome.hpp"

namespace flagstone::tests {

/// Types for tests with the method as parameter.
using LibraryMethods = testing::Types<Patchwork, Surface>;

/// A method with its default settings, and an instruction set.
using MethodOnTarget = std::tuple<std::string, std::string>;

inline auto methods_on_targets() {
  return testing::Combine(testing::Values("Patchwork", "Surface"),
                          testing::ValuesIn(simd_targets()));
}

inline std::string name_of(const testing::TestParamInfo<MethodOnTarget>& info) {
  return std::get<0>(info.param) + "_" + std::get<1>(info.param);
}

inline std::vector<Point> shuffled(std::vector<Point> cloud, std::uint32_t seed) {
  std::ranges::shuffle(cloud, std::mt19937(seed));
  return cloud;
}

}  // namespace flagstone::tests

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "library/core/simd_target.hpp"

namespace flagstone::tests {

/// Selects an instruction set for the lifetime of the object, and the best one afterwards.
class ForcedTarget {
 public:
  explicit ForcedTarget(std::string_view name) { use_simd_target(name); }
  ~ForcedTarget() { use_simd_target(""); }
  ForcedTarget(const ForcedTarget&) = delete;
  ForcedTarget& operator=(const ForcedTarget&) = delete;
};

}  // namespace flagstone::tests

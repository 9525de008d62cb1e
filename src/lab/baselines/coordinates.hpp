// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

namespace flagstone::baselines {

/// x, y and z of the same points, metres.
struct Coordinates {
  std::span<const float> x;
  std::span<const float> y;
  std::span<const float> z;

  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
};

}  // namespace flagstone::baselines

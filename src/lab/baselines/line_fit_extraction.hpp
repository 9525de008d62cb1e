// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "flagstone/baselines/line_fit.hpp"

namespace flagstone::baselines {

/// The lowest point of a bin, p'_bi, in the vertical plane of its segment.
struct Prototype {
  float range;   ///< sqrt(x^2 + y^2), metres
  float height;  ///< z, metres
};

/// A piece of ground in one segment: z = height + slope * (range - begin), for ranges begin to end.
struct GroundLine {
  float begin, end;  ///< ranges of its first and last prototype, metres
  float height;      ///< at `begin`, metres
  float slope;       ///< metres a metre

  [[nodiscard]] float height_at(float range) const noexcept {
    return height + slope * (range - begin);
  }
};

/// Algorithm 1: grows lines through the prototypes of one segment, nearest first, each as long as
/// all thresholds of `config` hold. Prototypes ascend in range. Lines of fewer than three points
/// are none. Writes the lines, nearest first, to `lines`, which has room for prototypes.size() / 2;
/// returns how many there are.
std::size_t extract_lines(std::span<const Prototype> prototypes, const LineFitConfig& config,
                          GroundLine* lines) noexcept;

}  // namespace flagstone::baselines

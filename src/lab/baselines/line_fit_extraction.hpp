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

/// A line of ground points in one segment: z = height + slope * (range - begin), from range `begin`
/// to `end`.
struct GroundLine {
  float begin, end;  ///< ranges of its first and last prototype, metres
  float height;      ///< at `begin`, metres
  float slope;       ///< m/m

  [[nodiscard]] float height_at(float range) const noexcept {
    return height + slope * (range - begin);
  }
};

/// Algorithm 1: fits lines to the prototypes of one segment, from the nearest outward. Each line is
/// extended while it satisfies all thresholds of `config`, and has at least three points.
/// `prototypes` must be sorted by range. Writes the lines, nearest first, to `lines`, which must
/// have room for prototypes.size() / 2 lines. Returns the number of lines.
std::size_t extract_lines(std::span<const Prototype> prototypes, const LineFitConfig& config,
                          GroundLine* lines) noexcept;

}  // namespace flagstone::baselines

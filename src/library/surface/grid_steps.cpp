// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/grid_steps.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/grid_steps.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

// Plain loops: the compiler makes vectors of them, for each instruction set its own.

/// Cells over which corrections fade at an inner edge.
inline constexpr std::size_t fading = 3;

void upsample_values(const float* coarse, std::size_t coarse_width, float* fine,
                     std::size_t fine_width) {
  const std::size_t margin =
      (coarse_width - fine_width / 2) / 2;  // coarse cells beside the fine grid
  const std::size_t last = coarse_width - 1;
  const auto beside = [&](std::size_t fine_index) {  // the coarse cell next nearest
    const std::size_t here = margin + fine_index / 2;
    if (fine_index % 2 == 0) return here > 0 ? here - 1 : 0;
    return std::min(here + 1, last);
  };
  for (std::size_t row = 0; row < fine_width; ++row) {
    const float* HWY_RESTRICT near = coarse + (margin + row / 2) * coarse_width;
    const float* HWY_RESTRICT far = coarse + beside(row) * coarse_width;
    float* HWY_RESTRICT values = fine + row * fine_width;
    const auto set = [&](std::size_t column, std::size_t here, std::size_t next) {
      values[column] = 0.75f * (0.75f * near[here] + 0.25f * far[here]) +
                       0.25f * (0.75f * near[next] + 0.25f * far[next]);
    };
    set(0, margin, beside(0));
    for (std::size_t pair = 0; pair + 1 < fine_width / 2; ++pair) {
      const std::size_t here = margin + pair;
      set(2 * pair + 1, here, here + 1);
      set(2 * pair + 2, here + 1, here);
    }
    set(fine_width - 1, margin + fine_width / 2 - 1, beside(fine_width - 1));
  }
}

void correct_values(const float* HWY_RESTRICT corrections, const float* HWY_RESTRICT confidences,
                    bool inner, const Grid& grid) {
  for (std::size_t row = 0; row < grid.width; ++row) {
    const std::size_t from_edge = std::min(row, grid.width - 1 - row);
    const float row_share =
        inner && from_edge < fading ? static_cast<float>(from_edge) / fading : 1.0f;
    const float* HWY_RESTRICT from = corrections + row * grid.width;
    const float* HWY_RESTRICT known = confidences + row * grid.width;
    float* HWY_RESTRICT heights = grid.heights + row * grid.width;
    float* HWY_RESTRICT confidence = grid.confidences + row * grid.width;
    const auto faded = [&](std::size_t column) {
      const std::size_t edge = std::min(column, grid.width - 1 - column);
      const float share = inner && edge < fading ? static_cast<float>(edge) / fading : 1.0f;
      heights[column] += std::min(share, row_share) * from[column];
    };
    const std::size_t side = std::min(fading, grid.width / 2);
    for (std::size_t column = 0; column < side; ++column) faded(column);
    for (std::size_t column = side; column < grid.width - side; ++column) {
      heights[column] += row_share * from[column];
    }
    for (std::size_t column = grid.width - side; column < grid.width; ++column) faded(column);
    for (std::size_t column = 0; column < grid.width; ++column) {
      confidence[column] = std::max(confidence[column], known[column]);
    }
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(upsample_values);
HWY_EXPORT(correct_values);
}  // namespace

void upsample(const Grid& coarse, const Grid& fine) noexcept {
  HWY_DYNAMIC_DISPATCH(upsample_values)(coarse.heights, coarse.width, fine.heights, fine.width);
  HWY_DYNAMIC_DISPATCH(upsample_values)
  (coarse.confidences, coarse.width, fine.confidences, fine.width);
}

void correct(const float* corrections, const float* confidences, bool inner,
             const Grid& grid) noexcept {
  HWY_DYNAMIC_DISPATCH(correct_values)(corrections, confidences, inner, grid);
}

}  // namespace flagstone::surface
#endif

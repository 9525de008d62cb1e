// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/grid.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_SURFACE_GRID_ONCE
#define FLAGSTONE_SURFACE_GRID_ONCE
namespace flagstone::surface {

/// A grid in memory, cell (row, column) at `values[row * stride + column]`.
struct FilledGrid {
  float* values;
  float* weights;
  std::size_t width;
  std::size_t stride;
};

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// For the rest of a row that does not fill a vector.
using ShortTag = hn::CappedTag<float, 4>;

// Loops without vectors are vectorised by the compiler for each instruction set.

/// Number of cells over which corrections fade at an inner edge.
inline constexpr std::size_t fading = 3;

void upsample_values(const float* coarse, std::size_t coarse_width, float* fine,
                     std::size_t fine_width) {
  const std::size_t margin =
      (coarse_width - fine_width / 2) / 2;  // coarse cells outside the fine grid, per side
  const std::size_t last = coarse_width - 1;
  const auto beside = [&](std::size_t fine_index) {  // the second-nearest coarse cell
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

/// Weighted means of two by two cells in two rows, for as many columns as fill whole vectors of D.
/// Returns the number of columns.
template <class D>
HWY_INLINE std::size_t pull_columns(D d, const FilledGrid& fine, std::size_t upper,
                                    std::size_t lower, float lower_there, float full,
                                    std::size_t first, std::size_t pairs, float* values,
                                    float* weights) {
  const auto most = hn::Set(d, full);
  const auto there = hn::Set(d, lower_there);
  const float* const v0 = fine.values + upper * fine.stride;
  const float* const v1 = fine.values + lower * fine.stride;
  const float* const w0 = fine.weights + upper * fine.stride;
  const float* const w1 = fine.weights + lower * fine.stride;
  std::size_t column = first;
  for (; column + hn::Lanes(d) <= pairs; column += hn::Lanes(d)) {
    hn::Vec<D> value_a, value_b, value_c, value_d, a, b, c, e;
    hn::LoadInterleaved2(d, v0 + 2 * column, value_a, value_b);
    hn::LoadInterleaved2(d, v1 + 2 * column, value_c, value_d);
    hn::LoadInterleaved2(d, w0 + 2 * column, a, b);
    hn::LoadInterleaved2(d, w1 + 2 * column, c, e);
    a = hn::Min(a, most);
    b = hn::Min(b, most);
    c = hn::Mul(hn::Min(c, most), there);
    e = hn::Mul(hn::Min(e, most), there);
    const auto weight = hn::Add(hn::Add(a, b), hn::Add(c, e));
    const auto sum = hn::Add(hn::Add(hn::Mul(a, value_a), hn::Mul(b, value_b)),
                             hn::Add(hn::Mul(c, value_c), hn::Mul(e, value_d)));
    const auto has_weight = hn::Gt(weight, hn::Zero(d));
    const auto divisor = hn::IfThenElse(has_weight, weight, hn::Set(d, 1.0f));
    hn::StoreU(hn::IfThenElseZero(has_weight, hn::Div(sum, divisor)), d, values + column);
    hn::StoreU(weight, d, weights + column);
  }
  return column;
}

/// Weighted means of two by two cells. If the width is odd, the last row and column have no
/// partner.
void pull(const FilledGrid& fine, const FilledGrid& coarse, float full) {
  for (std::size_t row = 0; row < coarse.width; ++row) {
    const std::size_t upper = 2 * row;
    const std::size_t lower = std::min(upper + 1, fine.width - 1);
    const float lower_there = upper + 1 < fine.width ? 1.0f : 0.0f;
    const float* HWY_RESTRICT v0 = fine.values + upper * fine.stride;
    const float* HWY_RESTRICT v1 = fine.values + lower * fine.stride;
    const float* HWY_RESTRICT w0 = fine.weights + upper * fine.stride;
    const float* HWY_RESTRICT w1 = fine.weights + lower * fine.stride;
    float* HWY_RESTRICT values = coarse.values + row * coarse.stride;
    float* HWY_RESTRICT weights = coarse.weights + row * coarse.stride;
    const auto pull_cell = [&](std::size_t column, std::size_t left, std::size_t right,
                               float right_there) {
      const float a = std::min(w0[left], full);
      const float b = std::min(w0[right], full) * right_there;
      const float c = std::min(w1[left], full) * lower_there;
      const float d = std::min(w1[right], full) * right_there * lower_there;
      const float weight = (a + b) + (c + d);
      const float sum = (a * v0[left] + b * v0[right]) + (c * v1[left] + d * v1[right]);
      values[column] = weight > 0 ? sum / weight : 0.0f;
      weights[column] = weight;
    };
    const std::size_t pairs = fine.width / 2;
    std::size_t column =
        pull_columns(FloatTag(), fine, upper, lower, lower_there, full, 0, pairs, values, weights);
    column = pull_columns(ShortTag(), fine, upper, lower, lower_there, full, column, pairs, values,
                          weights);
    for (; column < pairs; ++column) pull_cell(column, 2 * column, 2 * column + 1, 1.0f);
    if (pairs < coarse.width) pull_cell(pairs, 2 * pairs, 2 * pairs, 0.0f);
  }
}

/// Copies the outermost cells of a grid to the frame around it.
void frame(const FilledGrid& grid) {
  for (float* cells : {grid.values, grid.weights}) {
    const auto stride = static_cast<std::ptrdiff_t>(grid.stride);
    const auto width = static_cast<std::ptrdiff_t>(grid.width);
    for (std::ptrdiff_t row = 0; row < width; ++row) {
      float* const line = cells + row * stride;
      line[-1] = line[0];
      line[width] = line[width - 1];
    }
    std::copy_n(cells - 1, width + 2, cells - 1 - stride);
    std::copy_n(cells - 1 + (width - 1) * stride, width + 2, cells - 1 + width * stride);
  }
}

/// A row of a coarser grid and its neighbour, interpolated at the centres of a row of the finer
/// grid. Elements -1 and `width` are the frame.
struct FramedRow {
  std::array<float, most_width / 2 + 2 * lanes + 2> values, confidences;
};

void interpolate_row(const FilledGrid& coarse, std::ptrdiff_t near, std::ptrdiff_t far,
                     FramedRow& row) {
  const auto stride = static_cast<std::ptrdiff_t>(coarse.stride);
  const float* HWY_RESTRICT v_near = coarse.values + near * stride - 1;
  const float* HWY_RESTRICT v_far = coarse.values + far * stride - 1;
  const float* HWY_RESTRICT c_near = coarse.weights + near * stride - 1;
  const float* HWY_RESTRICT c_far = coarse.weights + far * stride - 1;
  for (std::size_t i = 0; i < coarse.width + 2; ++i) {
    row.values[i] = 0.75f * v_near[i] + 0.25f * v_far[i];
    row.confidences[i] = 0.75f * c_near[i] + 0.25f * c_far[i];
  }
}

/// Fills pairs of cells of a row, for as many pairs as fill whole vectors of D. Returns the number
/// of pairs.
template <class D>
HWY_INLINE std::size_t push_pairs(D d, const FramedRow& row, float per_weight, std::size_t first,
                                  std::size_t pairs, float* values, float* weights) {
  const auto one = hn::Set(d, 1.0f);
  const auto near_share = hn::Set(d, 0.75f);
  const auto far_share = hn::Set(d, 0.25f);
  std::size_t pair = first;
  for (; pair + hn::Lanes(d) <= pairs; pair += hn::Lanes(d)) {
    const auto push_cells = [&](std::size_t beside, hn::Vec<D>& value,
                                hn::Vec<D>& weight) HWY_ATTR {
      const auto blended = [&](const auto& coarse) HWY_ATTR {
        return hn::Add(hn::Mul(near_share, hn::LoadU(d, coarse.data() + pair + 1)),
                       hn::Mul(far_share, hn::LoadU(d, coarse.data() + beside)));
      };
      const auto known = hn::Min(one, hn::Mul(weight, hn::Set(d, per_weight)));
      const auto rest = hn::Sub(one, known);
      value = hn::Add(hn::Mul(known, value), hn::Mul(rest, blended(row.values)));
      weight = hn::Add(known, hn::Mul(rest, hn::Mul(hn::Set(d, 0.5f), blended(row.confidences))));
    };
    hn::Vec<D> left, right, left_weight, right_weight;
    hn::LoadInterleaved2(d, values + 2 * pair, left, right);
    hn::LoadInterleaved2(d, weights + 2 * pair, left_weight, right_weight);
    push_cells(pair, left, left_weight);
    push_cells(pair + 2, right, right_weight);
    hn::StoreInterleaved2(left, right, d, values + 2 * pair);
    hn::StoreInterleaved2(left_weight, right_weight, d, weights + 2 * pair);
  }
  return pair;
}

/// Fills the finer grid from the coarser one, which has a frame and contains confidences. Bilinear
/// between centres: three quarters of the enclosing coarse cell, one quarter of the next.
void push(const FilledGrid& coarse, const FilledGrid& fine, float full) {
  const float per_weight = 1 / full;
  FramedRow framed;
  for (std::size_t row = 0; row < fine.width; ++row) {
    const auto near = static_cast<std::ptrdiff_t>(row / 2);
    interpolate_row(coarse, near, row % 2 == 0 ? near - 1 : near + 1, framed);
    float* HWY_RESTRICT values = fine.values + row * fine.stride;
    float* HWY_RESTRICT weights = fine.weights + row * fine.stride;
    const auto push_cell = [&](std::size_t column, std::size_t here, std::size_t beside) {
      const float value = 0.75f * framed.values[here] + 0.25f * framed.values[beside];
      const float confidence =
          0.75f * framed.confidences[here] + 0.25f * framed.confidences[beside];
      const float known = std::min(1.0f, weights[column] * per_weight);
      values[column] = known * values[column] + (1 - known) * value;
      weights[column] = known + (1 - known) * (0.5f * confidence);
    };
    const std::size_t pairs = fine.width / 2;
    std::size_t pair = push_pairs(FloatTag(), framed, per_weight, 0, pairs, values, weights);
    pair = push_pairs(ShortTag(), framed, per_weight, pair, pairs, values, weights);
    for (; pair < pairs; ++pair) {
      push_cell(2 * pair, pair + 1, pair);
      push_cell(2 * pair + 1, pair + 1, pair + 2);
    }
    if (fine.width % 2 != 0) push_cell(2 * pairs, pairs + 1, pairs);
  }
}

/// Computes the confidence of the coarsest grid, which is one cell.
void settle(const FilledGrid& grid, float full) {
  grid.weights[0] = std::min(1.0f, grid.weights[0] / full);
}

void fill_grids(const FilledGrid* grids, std::size_t count, float full) {
  for (std::size_t i = 1; i < count; ++i) pull(grids[i - 1], grids[i], full);
  settle(grids[count - 1], full);
  for (std::size_t i = count - 1; i > 0; --i) {
    frame(grids[i]);
    push(grids[i], grids[i - 1], full);
  }
}

/// Odds of a height within 10 cm of the ground, by the confidence c from pull-push and the slope in
/// m/m: (least_odds + odds (c^2 + c^4)) / (level_slope + slope).
inline constexpr float least_odds = 0.008f;
inline constexpr float odds = 0.48f;
inline constexpr float level_slope = 0.013f;

/// Stores the first `count` lanes.
HWY_INLINE void store(FloatVector v, std::size_t count, float* to) {
  const FloatTag d;
  if (HWY_LIKELY(count >= hn::Lanes(d))) {
    hn::StoreU(v, d, to);
  } else {
    HWY_ALIGN std::array<float, lanes> all;
    hn::Store(v, d, all.data());
    std::copy_n(all.data(), count, to);
  }
}

void finish_grid(const Grid& grid, float least, float* heights, float* confidences) {
  const FloatTag d;
  const std::size_t width = grid.width;
  const FloatVector per_metre = hn::Set(d, 1 / (2 * grid.cell));
  const FloatVector unknown = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  // Rows of original heights with their ends repeated: the row before and this row.
  HWY_ALIGN std::array<std::array<float, most_width + 2 * lanes>, 2> rows{};
  const auto frame_row = [&](const float* row, std::array<float, most_width + 2 * lanes>& framed) {
    framed[0] = row[0];
    std::copy_n(row, width, framed.data() + 1);
    framed[width + 1] = row[width - 1];
  };
  frame_row(grid.heights, rows[1]);
  for (std::size_t row = 0; row < width; ++row) {
    float* const here = grid.heights + row * width;
    const float* const after = row + 1 < width ? here + width : here;
    const auto& before = rows[(row + 1) % 2];
    auto& framed = rows[row % 2];
    frame_row(here, framed);
    const float* const raw = grid.confidences + row * width;
    const auto finish_vector = [&](std::size_t i) HWY_ATTR {
      const FloatVector height = hn::LoadU(d, framed.data() + i + 1);
      const auto slope = [&](FloatVector from, FloatVector to)
                             HWY_ATTR { return hn::Mul(hn::Sub(to, from), per_metre); };
      const FloatVector slope_x =
          slope(hn::LoadU(d, framed.data() + i), hn::LoadU(d, framed.data() + i + 2));
      const FloatVector slope_y =
          slope(hn::LoadU(d, before.data() + i + 1), hn::LoadU(d, after + i));
      const FloatVector steepness =
          hn::Sqrt(hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)));
      const FloatVector c = hn::LoadU(d, raw + i);
      const FloatVector squared = hn::Mul(c, c);
      const FloatVector a =
          hn::Add(hn::Set(d, least_odds),
                  hn::Mul(hn::Set(d, odds), hn::Add(squared, hn::Mul(squared, squared))));
      const FloatVector against = hn::Add(hn::Set(d, level_slope), steepness);
      const auto known = hn::Ge(c, hn::Set(d, least));
      const FloatVector known_height = hn::IfThenElse(known, height, unknown);
      store(known_height, width - i, here + i);
      store(known_height, width - i, heights + row * width + i);
      store(hn::IfThenElseZero(known, hn::Div(a, hn::Add(a, against))), width - i,
            confidences + row * width + i);
    };
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) finish_vector(i);
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
HWY_EXPORT(fill_grids);
HWY_EXPORT(finish_grid);

constexpr std::size_t most_grids = 16;

std::size_t half_of(std::size_t width) { return (width + 1) / 2; }

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

void finish(const Grid& grid, float least, float* heights, float* confidences) noexcept {
  HWY_DYNAMIC_DISPATCH(finish_grid)(grid, least, heights, confidences);
}

PullPush::PullPush(std::size_t width) {
  std::size_t cells = 0;
  while (width > 1) {
    width = half_of(width);
    cells += (width + 2) * (width + 2);
  }
  values_.reserve(cells);
  weights_.reserve(cells);
}

void PullPush::fill(float* values, float* weights, std::size_t width, float full) noexcept {
  std::array<FilledGrid, most_grids> grids{};
  grids[0] = {.values = values, .weights = weights, .width = width, .stride = width};
  std::size_t count = 1;
  std::size_t first = 0;
  while (grids[count - 1].width > 1) {
    const std::size_t half = half_of(grids[count - 1].width);
    const std::size_t stride = half + 2;
    grids[count] = {.values = values_.data() + first + stride + 1,
                    .weights = weights_.data() + first + stride + 1,
                    .width = half,
                    .stride = stride};
    first += stride * stride;
    ++count;
  }
  HWY_DYNAMIC_DISPATCH(fill_grids)(grids.data(), count, full);
}

}  // namespace flagstone::surface
#endif

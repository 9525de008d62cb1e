// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/grid.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// For the rest of a row that does not fill a vector of sixteen lanes.
using ShortTag = hn::CappedTag<float, 4>;
using OneTag = hn::CappedTag<float, 1>;

/// Number of cells over which corrections fade at an inner edge.
inline constexpr std::size_t fading = 3;

/// Weighted means of two by two cells of two rows of a finer grid. The second row counts
/// `lower_there` times, 0 or 1.
struct PulledRow {
  const float *upper_values, *lower_values, *upper_weights, *lower_weights;
  float lower_there;
  float *values, *weights;  ///< of the coarser grid
};

/// Computes `pairs` means from number `first` on, as many as fill whole vectors of D. Returns their
/// end.
template <class D>
HWY_INLINE std::size_t pull_pairs(D d, const PulledRow& row, float full, std::size_t first,
                                  std::size_t pairs) {
  const auto most = hn::Set(d, full);
  const auto there = hn::Set(d, row.lower_there);
  std::size_t column = first;
  for (; column + hn::Lanes(d) <= pairs; column += hn::Lanes(d)) {
    hn::Vec<D> value_a, value_b, value_c, value_d, a, b, c, e;
    hn::LoadInterleaved2(d, row.upper_values + 2 * column, value_a, value_b);
    hn::LoadInterleaved2(d, row.lower_values + 2 * column, value_c, value_d);
    hn::LoadInterleaved2(d, row.upper_weights + 2 * column, a, b);
    hn::LoadInterleaved2(d, row.lower_weights + 2 * column, c, e);
    a = hn::Min(a, most);
    b = hn::Min(b, most);
    c = hn::Mul(hn::Min(c, most), there);
    e = hn::Mul(hn::Min(e, most), there);
    const auto weight = hn::Add(hn::Add(a, b), hn::Add(c, e));
    const auto sum = hn::Add(hn::Add(hn::Mul(a, value_a), hn::Mul(b, value_b)),
                             hn::Add(hn::Mul(c, value_c), hn::Mul(e, value_d)));
    const auto has_weight = hn::Gt(weight, hn::Zero(d));
    const auto divisor = hn::IfThenElse(has_weight, weight, hn::Set(d, 1.0f));
    hn::StoreU(hn::IfThenElseZero(has_weight, hn::Div(sum, divisor)), d, row.values + column);
    hn::StoreU(weight, d, row.weights + column);
  }
  return column;
}

/// Weighted means of two by two cells. If the width is odd, the last row has no partner, and that
/// of the last column has no weight.
void pull(const FilledGrid& fine, const FilledGrid& coarse, float full) {
  for (std::size_t row = 0; row < coarse.width; ++row) {
    const std::size_t upper = 2 * row * fine.stride;
    const std::size_t lower = std::min(2 * row + 1, fine.width - 1) * fine.stride;
    const PulledRow rows{.upper_values = fine.values + upper,
                         .lower_values = fine.values + lower,
                         .upper_weights = fine.weights + upper,
                         .lower_weights = fine.weights + lower,
                         .lower_there = 2 * row + 1 < fine.width ? 1.0f : 0.0f,
                         .values = coarse.values + row * coarse.stride,
                         .weights = coarse.weights + row * coarse.stride};
    const std::size_t pairs = fine.stride / 2;
    std::size_t column = pull_pairs(FloatTag(), rows, full, 0, pairs);
    column = pull_pairs(ShortTag(), rows, full, column, pairs);
    pull_pairs(OneTag(), rows, full, column, pairs);
    if (coarse.width % 2 != 0) rows.values[coarse.width] = rows.weights[coarse.width] = 0;
  }
}

/// Values and weights of a row of a coarser grid, interpolated at the centres of a row of a finer
/// grid. Element 0 belongs to the cell before the first one.
struct CoarseRow {
  std::array<float, most_width / 2 + lanes + 2> values{}, weights{};
};

/// Interpolates between two rows: three quarters of `near`, one quarter of `far`.
template <class D>
HWY_INLINE void interpolate_rows(D d, const float* near, const float* far, std::size_t count,
                                 float* to) {
  if constexpr (hn::MaxLanes(D()) > 1) {
    if (count < hn::Lanes(d)) {
      return interpolate_rows(hn::CappedTag<float, hn::MaxLanes(D()) / 2>(), near, far, count, to);
    }
  }
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t at = std::min(i, count - hn::Lanes(d));  // the last two vectors can overlap
    hn::StoreU(hn::Add(hn::Mul(hn::Set(d, 0.75f), hn::LoadU(d, near + at)),
                       hn::Mul(hn::Set(d, 0.25f), hn::LoadU(d, far + at))),
               d, to + at);
  }
}

/// Interleaves two vectors: `low` becomes a0, b0, a1, b1, ..., and `high` contains the second
/// halves.
template <class D>
HWY_INLINE void interleave([[maybe_unused]] D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D>& low,
                           hn::Vec<D>& high) {
  if constexpr (hn::MaxLanes(D()) == 1) {
    low = a;
    high = b;
#if HWY_TARGET <= HWY_AVX3
  } else if constexpr (hn::MaxLanes(D()) == lanes) {
    HWY_ALIGN static constexpr std::int32_t of_low[] = {0, 16, 1, 17, 2, 18, 3, 19,
                                                        4, 20, 5, 21, 6, 22, 7, 23};
    HWY_ALIGN static constexpr std::int32_t of_high[] = {8,  24, 9,  25, 10, 26, 11, 27,
                                                         12, 28, 13, 29, 14, 30, 15, 31};
    low = hn::Vec<D>{_mm512_permutex2var_ps(a.raw, _mm512_load_si512(of_low), b.raw)};
    high = hn::Vec<D>{_mm512_permutex2var_ps(a.raw, _mm512_load_si512(of_high), b.raw)};
#endif
#if HWY_TARGET != HWY_SCALAR
  } else {
    const hn::Vec<D> lower = hn::InterleaveLower(d, a, b);  // of each block of 128 bits
    const hn::Vec<D> upper = hn::InterleaveUpper(d, a, b);
    if constexpr (hn::MaxLanes(D()) * sizeof(float) == 16) {
      low = lower;
      high = upper;
    } else {
      low = hn::ConcatLowerLower(d, upper, lower);
      high = hn::ConcatUpperUpper(d, upper, lower);
    }
#endif
  }
}

/// Interpolates pairs of cells of a finer row, for as many pairs as fill whole vectors of D, and
/// passes them to `use(d, column, values, weights)`. Returns the number of pairs.
template <class D, class Use>
HWY_INLINE std::size_t interpolate_pairs(D d, const CoarseRow& row, std::size_t first,
                                         std::size_t pairs, const Use& use) {
  std::size_t pair = first;
  for (; pair + hn::Lanes(d) <= pairs; pair += hn::Lanes(d)) {
    const auto blend = [&](const auto& coarse, hn::Vec<D>& low, hn::Vec<D>& high) HWY_ATTR {
      const auto quarter = [&](std::size_t i) HWY_ATTR {
        return hn::Mul(hn::Set(d, 0.25f), hn::LoadU(d, coarse.data() + i));
      };
      const hn::Vec<D> here = hn::Mul(hn::Set(d, 0.75f), hn::LoadU(d, coarse.data() + pair + 1));
      interleave(d, hn::Add(here, quarter(pair)), hn::Add(here, quarter(pair + 2)), low, high);
    };
    hn::Vec<D> low_values, high_values, low_weights, high_weights;
    blend(row.values, low_values, high_values);
    blend(row.weights, low_weights, high_weights);
    use(d, 2 * pair, low_values, low_weights);
    use(d, 2 * pair + hn::Lanes(d), high_values, high_weights);
  }
  return pair;
}

/// Interpolates a coarser grid at the cells of a finer one with half the cell size and the same
/// centre. Bilinear between centres: three quarters of the enclosing coarse cell, one quarter of
/// the next. Calls `use(d, row, column, values, weights)` for each vector of cells of rows that
/// have `stride` cells in memory.
template <class Use>
HWY_INLINE void interpolate(const FilledGrid& coarse, std::size_t width, std::size_t stride,
                            const Use& use) {
  const std::size_t pairs = (width + 1) / 2;
  const std::size_t margin = (coarse.width - pairs) / 2;  // coarse cells outside, per side
  const std::size_t last = coarse.width - 1;
  // Cells beyond the edge have the height of the outermost cells.
  const std::size_t frame = margin > 0 ? 0 : 1;
  const std::size_t first = margin > 0 ? margin - 1 : 0;
  const std::size_t count = pairs + 2 - 2 * frame;
  std::array<CoarseRow, 2> rows;
  for (std::size_t row = 0; row <= width; ++row) {
    if (row < width) {
      const std::size_t here = margin + row / 2;
      const std::size_t beside =
          row % 2 == 0 ? std::max<std::size_t>(here, 1) - 1 : std::min(here + 1, last);
      const std::size_t near = here * coarse.stride + first;
      const std::size_t far = beside * coarse.stride + first;
      const auto set = [&](const float* cells, auto& to) HWY_ATTR {
        interpolate_rows(FloatTag(), cells + near, cells + far, count, to.data() + frame);
        if (frame == 0) return;
        to[0] = to[1];
        to[pairs + 1] = to[pairs];
      };
      set(coarse.values, rows[row % 2].values);
      set(coarse.weights, rows[row % 2].weights);
    }
    if (row == 0) continue;
    // One row later, because numbers cannot be loaded at once after they were stored.
    const CoarseRow& before = rows[(row - 1) % 2];
    const auto use_in_row = [&](auto d, std::size_t column, auto values, auto weights)
                                HWY_ATTR { use(d, row - 1, column, values, weights); };
    std::size_t pair = interpolate_pairs(FloatTag(), before, 0, stride / 2, use_in_row);
    pair = interpolate_pairs(ShortTag(), before, pair, stride / 2, use_in_row);
    interpolate_pairs(OneTag(), before, pair, stride / 2, use_in_row);
  }
}

void upsample_grid(const Grid& coarse, Grid fine) {
  const FilledGrid from{.values = coarse.heights,
                        .weights = coarse.confidences,
                        .width = coarse.width,
                        .stride = coarse.width};
  interpolate(from, fine.width, fine.width,
              [=](auto d, std::size_t row, std::size_t column, auto heights, auto confidences)
                  HWY_ATTR {
                    const std::size_t cell = row * fine.width + column;
                    hn::StoreU(heights, d, fine.heights + cell);
                    hn::StoreU(confidences, d, fine.confidences + cell);
                  });
}

/// Fills cells of the finer grid from the coarser one, which contains confidences, and passes them
/// to `use(d, row, column, values, confidences)`.
template <class Use>
HWY_INLINE void push(const FilledGrid& coarse, FilledGrid fine, float full, const Use& use) {
  const float per_weight = 1 / full;
  interpolate(
      coarse, fine.width, fine.stride,
      [=](auto d, std::size_t row, std::size_t column, auto values, auto confidences) HWY_ATTR {
        const std::size_t cell = row * fine.stride + column;
        const auto one = hn::Set(d, 1.0f);
        const auto known =
            hn::Min(one, hn::Mul(hn::LoadU(d, fine.weights + cell), hn::Set(d, per_weight)));
        const auto rest = hn::Sub(one, known);
        use(d, row, column,
            hn::Add(hn::Mul(known, hn::LoadU(d, fine.values + cell)), hn::Mul(rest, values)),
            hn::Add(known, hn::Mul(rest, hn::Mul(hn::Set(d, 0.5f), confidences))));
      });
}

void push_in_place(const FilledGrid& coarse, FilledGrid fine, float full) {
  push(coarse, fine, full,
       [=](auto d, std::size_t row, std::size_t column, auto values, auto confidences) HWY_ATTR {
         const std::size_t cell = row * fine.stride + column;
         hn::StoreU(values, d, fine.values + cell);
         hn::StoreU(confidences, d, fine.weights + cell);
       });
}

/// Computes the confidence of the coarsest grid, which is one cell.
void settle(const FilledGrid& grid, float full) {
  grid.weights[0] = std::min(1.0f, grid.weights[0] / full);
}

/// Fills the grids from the coarsest to grids[1].
void fill_coarse_grids(const FilledGrid* grids, std::size_t count, float full) {
  for (std::size_t i = 1; i < count; ++i) pull(grids[i - 1], grids[i], full);
  settle(grids[count - 1], full);
  for (std::size_t i = count - 1; i > 1; --i) push_in_place(grids[i], grids[i - 1], full);
}

void fill_grids(const FilledGrid* grids, std::size_t count, float full) {
  fill_coarse_grids(grids, count, full);
  push_in_place(grids[1], grids[0], full);
}

void correct_grid(const FilledGrid* grids, std::size_t count, float full, bool inner, Grid grid) {
  fill_coarse_grids(grids, count, full);
  HWY_ALIGN std::array<float, most_width + lanes> shares;  // by distance from the edge
  std::ranges::fill(shares, 1.0f);
  for (std::size_t i = 0; inner && i < std::min(fading, grid.width / 2); ++i) {
    shares[i] = shares[grid.width - 1 - i] = static_cast<float>(i) / fading;
  }
  const FilledGrid from = grids[0];
  push(grids[1], from, full,
       [=, &shares](auto d, std::size_t row, std::size_t column, auto corrections,
                    auto confidences) HWY_ATTR {
         const std::size_t cell = row * grid.width + column;
         const auto share = hn::Min(hn::LoadU(d, shares.data() + column), hn::Set(d, shares[row]));
         float* const heights = grid.heights + cell;
         float* const known = grid.confidences + cell;
         hn::StoreU(hn::Add(hn::LoadU(d, heights), hn::Mul(share, corrections)), d, heights);
         hn::StoreU(hn::Max(hn::LoadU(d, known), confidences), d, known);
         hn::StoreU(hn::Zero(d), d, from.values + cell);
         hn::StoreU(hn::Zero(d), d, from.weights + cell);
       });
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
      const FloatVector c = hn::LoadU(d, raw + i);
      const auto known = hn::Ge(c, hn::Set(d, least));
      const auto write = [&](FloatVector height, FloatVector confidence) HWY_ATTR {
        store(height, width - i, here + i);
        store(height, width - i, heights + row * width + i);
        store(confidence, width - i, confidences + row * width + i);
      };
      if (hn::AllFalse(d, known)) return write(unknown, hn::Zero(d));
      const FloatVector height = hn::LoadU(d, framed.data() + i + 1);
      const auto slope = [&](FloatVector from, FloatVector to)
                             HWY_ATTR { return hn::Mul(hn::Sub(to, from), per_metre); };
      const FloatVector slope_x =
          slope(hn::LoadU(d, framed.data() + i), hn::LoadU(d, framed.data() + i + 2));
      const FloatVector slope_y =
          slope(hn::LoadU(d, before.data() + i + 1), hn::LoadU(d, after + i));
      const FloatVector steepness =
          hn::Sqrt(hn::Add(hn::Mul(slope_x, slope_x), hn::Mul(slope_y, slope_y)));
      const FloatVector squared = hn::Mul(c, c);
      const FloatVector a =
          hn::Add(hn::Set(d, least_odds),
                  hn::Mul(hn::Set(d, odds), hn::Add(squared, hn::Mul(squared, squared))));
      const FloatVector against = hn::Add(hn::Set(d, level_slope), steepness);
      write(hn::IfThenElse(known, height, unknown),
            hn::IfThenElseZero(known, hn::Div(a, hn::Add(a, against))));
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
HWY_EXPORT(upsample_grid);
HWY_EXPORT(fill_grids);
HWY_EXPORT(correct_grid);
HWY_EXPORT(finish_grid);

/// Cells in memory per row of a grid of PullPush: whole vectors of pairs of cells.
std::size_t stride_of(std::size_t width) { return (width + 31) / 32 * 32; }

std::size_t half_of(std::size_t width) { return (width + 1) / 2; }

}  // namespace

void upsample(const Grid& coarse, const Grid& fine) noexcept {
  HWY_DYNAMIC_DISPATCH(upsample_grid)(coarse, fine);
}

void finish(const Grid& grid, float least, float* heights, float* confidences) noexcept {
  HWY_DYNAMIC_DISPATCH(finish_grid)(grid, least, heights, confidences);
}

PullPush::PullPush(std::size_t width) {
  std::size_t cells = 0;
  while (width > 1) {
    width = half_of(width);
    cells += width * stride_of(width);
  }
  values_.reserve(cells);
  weights_.reserve(cells);
  std::fill_n(values_.data(), cells, 0.0f);
  std::fill_n(weights_.data(), cells, 0.0f);
}

std::size_t PullPush::list_grids(float* values, float* weights, std::size_t width,
                                 Grids& grids) noexcept {
  grids[0] = {.values = values, .weights = weights, .width = width, .stride = width};
  std::size_t count = 1;
  std::size_t first = 0;
  while (grids[count - 1].width > 1) {
    const std::size_t half = half_of(grids[count - 1].width);
    grids[count] = {.values = values_.data() + first,
                    .weights = weights_.data() + first,
                    .width = half,
                    .stride = stride_of(half)};
    first += half * grids[count].stride;
    ++count;
  }
  return count;
}

void PullPush::fill(float* values, float* weights, std::size_t width, float full) noexcept {
  Grids grids{};
  const std::size_t count = list_grids(values, weights, width, grids);
  HWY_DYNAMIC_DISPATCH(fill_grids)(grids.data(), count, full);
}

void PullPush::correct(float* corrections, float* weights, float full, bool inner,
                       const Grid& grid) noexcept {
  Grids grids{};
  const std::size_t count = list_grids(corrections, weights, grid.width, grids);
  HWY_DYNAMIC_DISPATCH(correct_grid)(grids.data(), count, full, inner, grid);
}

}  // namespace flagstone::surface
#endif

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/cell_observations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/cell_observations.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_SURFACE_CELL_OBSERVATIONS_ONCE
#define FLAGSTONE_SURFACE_CELL_OBSERVATIONS_ONCE
namespace flagstone::surface {

/// Number of cells that are observed together, and points per cell in one block.
inline constexpr std::size_t tile_cells = 16;
inline constexpr std::size_t block_rows = 16;

/// Maximum number of points used per cell.
inline constexpr std::size_t most_samples = 32;
static_assert(small_cell % block_rows == 0 && most_samples % block_rows == 0);

/// Heights above the surface, metres, of sixteen points of sixteen cells; infinite in unused slots.
using HeightBlock = std::array<float, tile_cells * block_rows>;

// Points this far below and above the gate are used, metres.
inline constexpr float depth_below_gate = 1.5f;
inline constexpr float height_above_gate = 1.0f;

/// Half-width of the window whose mean height is the height of the surface, metres.
inline constexpr float window = 0.12f;

// Lower and upper limit of the slab in which points on obstacles are counted, metres above the
// mean.
inline constexpr float slab_bottom = 0.18f;
inline constexpr float slab_top = 0.88f;

/// Maximum fraction `most_below` of points that lie more than `below_window` below the mean,
/// metres.
inline constexpr float below_window = 0.144f;
inline constexpr float most_below = 0.05f;

/// Minimum number of points in a cell: for an observation, for an observation with full weight, and
/// for a lower bound.
inline constexpr float fewest_points = 3;
inline constexpr float points_of_full_weight = 10;
inline constexpr float fewest_for_lower_bound = 8;

/// One or two points that lie more than this below the next point are reflections, metres.
inline constexpr float reflection_gap = 0.2f;

/// Minimum depth of a lower bound below the surface, metres.
inline constexpr float least_lowering = 0.03f;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// The surface within a cell, approximated by a plane.
struct CellPlane {
  float x, y;              ///< centre of the cell, metres
  float z;                 ///< at the centre, metres
  float slope_x, slope_y;  ///< m/m
};

CellPlane plane_in(const Grid& grid, const OccupiedCell& cell) {
  const std::size_t last = grid.width - 1;
  const float* HWY_RESTRICT row = grid.heights + cell.row * grid.width;
  const std::size_t left = cell.column > 0 ? cell.column - 1 : 0;
  const std::size_t right = std::min<std::size_t>(cell.column + 1, last);
  const std::size_t before = cell.row > 0 ? cell.row - 1 : 0;
  const std::size_t after = std::min<std::size_t>(cell.row + 1, last);
  const auto slope = [&](float from, float to, std::size_t cells) {
    return (to - from) / (static_cast<float>(cells) * grid.cell);
  };
  return {.x = grid.center(cell.column),
          .y = grid.center(cell.row),
          .z = row[cell.column],
          .slope_x = slope(row[left], row[right], right - left),
          .slope_y = slope(grid.heights[before * grid.width + cell.column],
                           grid.heights[after * grid.width + cell.column], after - before)};
}

/// Computes the heights of up to sixteen points above the plane.
HWY_INLINE void measure(const plane_fits::MovedPoint* points, std::size_t count,
                        const CellPlane& plane, float* heights) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector x, y, z;
    load_points<4>(&points[lane].x, x, y, z);
    const FloatVector along_x = hn::Mul(hn::Sub(x, hn::Set(d, plane.x)), hn::Set(d, plane.slope_x));
    const FloatVector along_y = hn::Mul(hn::Sub(y, hn::Set(d, plane.y)), hn::Set(d, plane.slope_y));
    const FloatVector height = hn::Sub(hn::Sub(hn::Sub(z, hn::Set(d, plane.z)), along_x), along_y);
    const auto there =
        hn::Lt(hn::Iota(d, static_cast<float>(lane)), hn::Set(d, static_cast<float>(count)));
    hn::StoreU(hn::IfThenElse(there, height, hn::Set(d, std::numeric_limits<float>::infinity())), d,
               heights + lane);
  }
}

/// Transposes a block from cell-major to point-major order, with two passes of LoadInterleaved4.
void transpose(HeightBlock& block) {
  const FloatTag d;
  HWY_ALIGN HeightBlock turned;
  const auto turn = [&](const float* from, float* to) HWY_ATTR {
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
        FloatVector v0, v1, v2, v3;
        hn::LoadInterleaved4(d, from + 64 * quarter + 4 * lane, v0, v1, v2, v3);
        float* const there = to + 16 * quarter + lane;
        hn::StoreU(v0, d, there);
        hn::StoreU(v1, d, there + 64);
        hn::StoreU(v2, d, there + 128);
        hn::StoreU(v3, d, there + 192);
      }
    }
  };
  turn(block.data(), turned.data());
  turn(turned.data(), block.data());
}

/// Observes one cell per lane. Each cell has `rows` heights, which this function overwrites.
template <std::size_t rows>
HWY_INLINE void observe_lanes(float* HWY_RESTRICT heights, FloatVector gate, const Observations& o,
                              FloatVector& correction, FloatVector& weight) {
  const FloatTag d;
  const FloatVector zero = hn::Zero(d);
  const FloatVector one = hn::Set(d, 1.0f);
  const FloatVector none = hn::Set(d, std::numeric_limits<float>::infinity());
  const FloatVector bottom = hn::Neg(hn::Add(gate, hn::Set(d, depth_below_gate)));
  const FloatVector top = hn::Add(gate, hn::Set(d, height_above_gate));

  // Counts the points and the points within the gate, and finds the three lowest heights of each.
  // Points outside the observed range become infinitely high.
  FloatVector seen = zero;
  FloatVector gated = zero;
  FloatVector lowest = none;
  FloatVector second_lowest = none;
  FloatVector third_lowest = none;
  FloatVector first = none;
  FloatVector second = none;
  FloatVector third = none;
  for (std::size_t row = 0; row < rows; ++row) {
    const FloatVector height = hn::Load(d, heights + row * tile_cells);
    const auto is_seen = hn::And(hn::Gt(height, bottom), hn::Lt(height, top));
    const FloatVector h = hn::IfThenElse(is_seen, height, none);
    hn::Store(h, d, heights + row * tile_cells);
    seen = hn::Add(seen, hn::IfThenElseZero(is_seen, one));
    const FloatVector not_lowest = hn::Max(lowest, h);
    lowest = hn::Min(lowest, h);
    const FloatVector not_second_lowest = hn::Max(second_lowest, not_lowest);
    second_lowest = hn::Min(second_lowest, not_lowest);
    third_lowest = hn::Min(third_lowest, not_second_lowest);
    const auto is_gated = hn::Le(hn::Abs(h), gate);
    gated = hn::Add(gated, hn::IfThenElseZero(is_gated, one));
    const FloatVector candidate = hn::IfThenElse(is_gated, h, none);
    const FloatVector not_first = hn::Max(first, candidate);
    first = hn::Min(first, candidate);
    const FloatVector not_second = hn::Max(second, not_first);
    second = hn::Min(second, not_first);
    third = hn::Min(third, not_second);
  }

  // One or two points far below the others are reflections.
  const auto is_alone = [&](FloatVector low, FloatVector next) HWY_ATTR {
    return hn::Gt(hn::Sub(next, low), hn::Set(d, reflection_gap));
  };
  const FloatVector of_the_rest =
      hn::IfThenElse(is_alone(second_lowest, third_lowest), third_lowest, second_lowest);
  const FloatVector bound = hn::IfThenElse(is_alone(lowest, second_lowest), of_the_rest, lowest);

  // Finds the lowest mode of the heights within the gate: the window moves to the mean of its
  // points.
  FloatVector mean = hn::IfThenElse(hn::Lt(gated, hn::Set(d, 10.0f)), second, third);
  mean = hn::IfThenElse(hn::Lt(gated, hn::Set(d, 5.0f)), first, mean);
  const auto window_of = [&](FloatVector& low, FloatVector& high) HWY_ATTR {
    low = hn::Max(hn::Sub(mean, hn::Set(d, window)), hn::Neg(gate));
    high = hn::Min(hn::Add(mean, hn::Set(d, window)), gate);
  };
  FloatVector low, high;
  for (int step = 0; step < 2; ++step) {
    window_of(low, high);
    FloatVector sum = zero;
    FloatVector count = zero;
    for (std::size_t row = 0; row < rows; ++row) {
      const FloatVector h = hn::Load(d, heights + row * tile_cells);
      const auto inside = hn::And(hn::Ge(h, low), hn::Le(h, high));
      sum = hn::Add(sum, hn::IfThenElseZero(inside, h));
      count = hn::Add(count, hn::IfThenElseZero(inside, one));
    }
    mean = hn::Div(sum, hn::Max(count, one));
  }

  window_of(low, high);
  FloatVector at_surface = zero;
  FloatVector above = zero;
  FloatVector below = zero;
  const FloatVector slab_low = hn::Add(mean, hn::Set(d, slab_bottom));
  const FloatVector slab_high = hn::Add(mean, hn::Set(d, slab_top));
  const FloatVector too_low = hn::Sub(mean, hn::Set(d, below_window));
  const FloatVector gate_below = hn::Neg(gate);
  for (std::size_t row = 0; row < rows; ++row) {
    const FloatVector h = hn::Load(d, heights + row * tile_cells);
    const auto inside = hn::And(hn::Ge(h, low), hn::Le(h, high));
    at_surface = hn::Add(at_surface, hn::IfThenElseZero(inside, one));
    const auto is_above = hn::And(hn::Gt(h, slab_low), hn::Lt(h, slab_high));
    above = hn::Add(above, hn::IfThenElseZero(is_above, one));
    const auto is_below = hn::And(hn::Ge(h, gate_below), hn::Lt(h, too_low));
    below = hn::Add(below, hn::IfThenElseZero(is_below, one));
  }

  const FloatVector fewest = hn::Set(d, fewest_points);
  const auto has_mode = hn::And(hn::Ge(gated, fewest), hn::Ge(at_surface, fewest));
  const auto has_obstacle = hn::Gt(above, hn::Mul(hn::Set(d, o.max_clutter_ratio), at_surface));
  const auto is_mode = hn::And(hn::AndNot(has_obstacle, has_mode),
                               hn::Le(below, hn::Mul(hn::Set(d, most_below), at_surface)));
  const auto only_below = hn::And(hn::Lt(gated, fewest), hn::Lt(bound, gate_below));
  const auto is_bound = hn::And(hn::And(hn::Or(only_below, hn::And(has_mode, has_obstacle)),
                                        hn::Ge(seen, hn::Set(d, fewest_for_lower_bound))),
                                hn::Lt(bound, hn::Set(d, -least_lowering)));

  const FloatVector mode_weight =
      hn::Min(one, hn::Mul(at_surface, hn::Set(d, 1 / points_of_full_weight)));
  weight = hn::IfThenElse(is_mode, mode_weight,
                          hn::IfThenElseZero(is_bound, hn::Set(d, o.lower_bound_weight)));
  correction = hn::IfThenElse(is_mode, mean, hn::IfThenElseZero(is_bound, bound));
}

/// Writes the observations of a tile of cells into the grid.
void note(const Observations& o, std::span<const OccupiedCell> cells, const float* corrections,
          const float* weights) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (weights[i] <= 0) continue;
    const std::size_t cell = cells[i].row * o.surface->width + cells[i].column;
    o.corrections[cell] = corrections[i];
    o.weights[cell] = weights[i];
  }
}

/// Observes up to sixteen cells, with up to `rows` points per cell, selected evenly from its
/// points.
template <std::size_t rows>
HWY_INLINE void observe_tile(const Observations& o, std::span<const OccupiedCell> cells) {
  const FloatTag d;
  constexpr float nothing = std::numeric_limits<float>::infinity();
  constexpr std::size_t block_count = rows / block_rows;
  HWY_ALIGN std::array<HeightBlock, block_count> blocks;
  HWY_ALIGN std::array<float, tile_cells> gates{};
  HWY_ALIGN std::array<plane_fits::MovedPoint, most_samples> picked;
  for (std::size_t i = 0; i < tile_cells; ++i) {
    const auto column = [&](std::size_t block) { return blocks[block].data() + i * block_rows; };
    if (i >= cells.size()) {
      for (std::size_t block = 0; block < block_count; ++block) {
        std::fill_n(column(block), block_rows, nothing);
      }
      continue;
    }
    const OccupiedCell& cell = cells[i];
    const CellPlane plane = plane_in(*o.surface, cell);
    gates[i] = o.gate + o.gate_per_metre * std::sqrt(plane.x * plane.x + plane.y * plane.y);
    const plane_fits::MovedPoint* points = o.points + cell.first;
    std::size_t samples = cell.count;
    if (samples > rows) {
      for (std::size_t j = 0; j < rows; ++j) picked[j] = points[j * cell.count / rows];
      points = picked.data();
      samples = rows;
    }
    for (std::size_t block = 0; block < block_count; ++block) {
      const std::size_t first = block * block_rows;
      if (first < samples) {
        measure(points + first, samples - first, plane, column(block));
      } else {
        std::fill_n(column(block), block_rows, nothing);
      }
    }
  }
  for (HeightBlock& block : blocks) transpose(block);

  HWY_ALIGN std::array<float, tile_cells> corrections;
  HWY_ALIGN std::array<float, tile_cells> weights;
  for (std::size_t lane = 0; lane < tile_cells; lane += hn::Lanes(d)) {
    FloatVector correction, weight;
    observe_lanes<rows>(blocks[0].data() + lane, hn::Load(d, gates.data() + lane), o, correction,
                        weight);
    hn::Store(correction, d, corrections.data() + lane);
    hn::Store(weight, d, weights.data() + lane);
  }
  note(o, cells, corrections.data(), weights.data());
}

void observe_cells(const Observations& o, std::span<const OccupiedCell> cells, bool small) {
  for (std::size_t begin = 0; begin < cells.size(); begin += tile_cells) {
    const auto tile = cells.subspan(begin, std::min(tile_cells, cells.size() - begin));
    if (small) {
      observe_tile<small_cell>(o, tile);
    } else {
      observe_tile<most_samples>(o, tile);
    }
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(observe_cells);
}  // namespace

void observe(const Observations& observations, std::span<const OccupiedCell> cells,
             CellSize size) noexcept {
  HWY_DYNAMIC_DISPATCH(observe_cells)(observations, cells, size == CellSize::small);
}

}  // namespace flagstone::surface
#endif

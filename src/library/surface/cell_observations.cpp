// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/cell_observations.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/cell_observations.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/surface/content_sample-inl.hpp"

#ifndef FLAGSTONE_SURFACE_CELL_OBSERVATIONS_ONCE
#define FLAGSTONE_SURFACE_CELL_OBSERVATIONS_ONCE
namespace flagstone::surface {

/// Number of cells that are observed together, and points per cell in one block.
inline constexpr std::size_t tile_cells = 32;
inline constexpr std::size_t block_rows = 16;

/// Number of points used of cells of a size.
constexpr std::size_t rows_of(CellSize size) {
  return size == CellSize::small ? small_cell : medium_cell;
}
static_assert(small_cell % block_rows == 0 && medium_cell % block_rows == 0);

/// Heights above the surface of sixteen points of 32 cells; `no_height` in unused elements.
using HeightBlock = std::array<std::int16_t, tile_cells * block_rows>;
inline constexpr std::int16_t no_height = std::numeric_limits<std::int16_t>::max();

/// Fixed-point precision of CellPlanes: slopes up to 4 m/m.
inline constexpr int plane_shift = 11;
inline constexpr float slope_unit =
    static_cast<float>(1 << plane_shift) * z_per_metre / xy_per_metre;
inline constexpr float most_slope = 32700;
inline constexpr float offset_unit = static_cast<float>(1 << plane_shift) * z_per_metre;
inline constexpr float most_offset = 200 * offset_unit;

/// A length in units of a packed z, rounded down.
constexpr std::int16_t units(double metres) {
  return static_cast<std::int16_t>(metres * z_per_metre);
}

// Points this far below and above the gate are used.
inline constexpr std::int16_t depth_below_gate = units(1.5);
inline constexpr std::int16_t height_above_gate = units(1.0);

/// Half-width of the window whose mean height is the height of the surface.
inline constexpr std::int16_t window = units(0.12);

// Lower and upper limit of the slab in which points on obstacles are counted, above the mean.
inline constexpr std::int16_t slab_bottom = units(0.18);
inline constexpr std::int16_t slab_top = units(0.88);

/// Maximum fraction `most_below` of points that lie more than `below_window` below the mean.
inline constexpr std::int16_t below_window = units(0.144);
inline constexpr float most_below = 0.05f;

/// Minimum number of points in a cell: for an observation, for an observation with full weight, and
/// for a lower bound.
inline constexpr std::int16_t fewest_points = 3;
inline constexpr float points_of_full_weight = 10;
inline constexpr std::int16_t fewest_for_lower_bound = 8;

/// One or two points that lie more than this below the next point are reflections.
inline constexpr std::int16_t reflection_gap = units(0.2);

/// Minimum depth of a lower bound below the surface.
inline constexpr std::int16_t least_lowering = units(0.03);

/// A second look finds a height only if at least `least_share` of the points near the surface are
/// at the surface, and the clutter ratio is at most `second_clutter_ratio`.
inline constexpr float least_share = 0.5f;
inline constexpr float second_clutter_ratio = 0.1f;

/// The slope in a cell is the difference between the lowest points of its halves. Each half must
/// have this many points.
inline constexpr std::int16_t fewest_in_half = 2;

/// How a cell is observed.
enum class Look : std::uint8_t {
  first,
  tilted,  ///< second look, with SecondLook::tilted
  wide     ///< second look, with SecondLook::wide
};

/// Statistics of the points of 32 cells, heights in units of a packed z.
struct alignas(64) TileStatistics {
  using PerCell = std::array<std::int16_t, tile_cells>;
  PerCell seen;        ///< number of points near the surface
  PerCell gated;       ///< number of points within the gate
  PerCell bound;       ///< the lowest point that is not a reflection
  PerCell mean;        ///< centre of the window before the last step
  PerCell sum, count;  ///< over the window: heights above `mean`, points
  PerCell at_surface;  ///< number of points in the final window
  PerCell above;       ///< number of points just above it
  PerCell below;       ///< number of points below it
};

/// Height with sides: the height of a point times 4, plus the halves of the cell that contain it.
/// Heights of 16 m or more are saturated.
inline constexpr int side_bits = 2;
inline constexpr std::int16_t side_x = 1;
inline constexpr std::int16_t side_y = 2;
inline constexpr std::int16_t most_with_sides = no_height >> side_bits;

/// Two cells: points, of which the first sixteen are measured, and planes. 16 elements of `points`
/// must be readable.
struct CellPair {
  std::array<std::span<const PackedPoint>, 2> points;
  std::array<std::int32_t, 2> slopes{};  ///< see CellPlanes
  std::array<std::int32_t, 2> offsets{};
};

/// Value of `half_bit` to measure heights without sides.
inline constexpr int no_sides = 0;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

using ShortTag = hn::CappedTag<std::int16_t, tile_cells>;
using ShortVector = hn::Vec<ShortTag>;
using ShortMask = hn::Mask<ShortTag>;

inline constexpr SampleSize sample_size{.most = medium_cell, .wanted = 26};

// --- The planes of cells
// ---------------------------------------------------------------------------

/// Distance from a packed x of 0 to the centre of a cell, in halves of a unit, less the half unit
/// that packed coordinates are rounded down on average.
std::int32_t to_centre(std::size_t index, float cell) {
  const auto per_packed_cell = static_cast<std::size_t>(packed_cell / cell);
  const auto units_of_cell = static_cast<std::size_t>(cell * xy_per_metre);
  return static_cast<std::int32_t>((2 * (index % per_packed_cell) + 1) * units_of_cell) - 1;
}

/// The nearest integers to numbers between -2^31 and 2^31. Faster than hn::NearestInt, which
/// handles all numbers.
HWY_INLINE IntVector nearest(FloatVector v) {
#if HWY_TARGET <= HWY_AVX3
  return IntVector{_mm512_cvtps_epi32(v.raw)};
#elif HWY_TARGET == HWY_AVX2
  return IntVector{_mm256_cvtps_epi32(v.raw)};
#else
  return hn::NearestInt(v);
#endif
}

void find_planes_of(const Grid& grid, float packed_zero, const CellPlanes& planes) {
  const FloatTag d;
  const IntTag di;
  const std::size_t width = grid.width;
  const FloatVector most = hn::Set(d, most_offset);
  const auto slope = [&](FloatVector from, FloatVector to, FloatVector per_metre) HWY_ATTR {
    const FloatVector limit = hn::Set(d, most_slope);
    const FloatVector scaled = hn::Mul(hn::Sub(to, from), per_metre);
    return nearest(hn::Max(hn::Min(scaled, limit), hn::Neg(limit)));
  };

  // Centres of cells, which repeat with the packed cells, and factors of differences.
  HWY_ALIGN std::array<std::int32_t, lanes> centres;
  for (std::size_t i = 0; i < lanes; ++i) centres[i] = to_centre(i, grid.cell);
  const float two_sided = slope_unit / (2 * grid.cell);
  const float one_sided = slope_unit / grid.cell;
  HWY_ALIGN std::array<float, most_width + lanes> factors;
  std::ranges::fill(factors, two_sided);
  factors[0] = factors[width - 1] = one_sided;

  HWY_ALIGN std::array<float, most_width + 2 * lanes> framed{};  // a row, its ends repeated
  for (std::size_t row = 0; row < width; ++row) {
    const float* const here = grid.heights + row * width;
    const float* const before = row > 0 ? here - width : here;
    const float* const after = row + 1 < width ? here + width : here;
    framed[0] = here[0];
    std::copy_n(here, width, framed.data() + 1);
    framed[width + 1] = here[width - 1];
    const FloatVector factor_y = hn::Set(d, row > 0 && row + 1 < width ? two_sided : one_sided);
    const IntVector row_centre = hn::Set(di, to_centre(row, grid.cell) * 65536);
    for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
      const IntVector slope_x =
          slope(hn::LoadU(d, framed.data() + i), hn::LoadU(d, framed.data() + i + 2),
                hn::Load(d, factors.data() + i));
      const IntVector slope_y = slope(hn::LoadU(d, before + i), hn::LoadU(d, after + i), factor_y);
      const IntVector slopes =
          hn::Or(hn::And(slope_x, hn::Set(di, 0xFFFF)), hn::ShiftLeft<16>(slope_y));
      const FloatVector height =
          hn::Mul(hn::Sub(hn::LoadU(d, framed.data() + i + 1), hn::Set(d, packed_zero)),
                  hn::Set(d, offset_unit));
      const IntVector centre_height = nearest(hn::Max(hn::Min(height, most), hn::Neg(most)));
      const IntVector centre = hn::Or(hn::Load(di, centres.data() + i % lanes), row_centre);
      const IntVector to_corner = hn::ShiftRight<1>(sum_of_products(slopes, centre));
      // The excess of a row is overwritten by the next row.
      hn::StoreU(slopes, di, planes.slopes + row * width + i);
      hn::StoreU(hn::Add(hn::Sub(centre_height, to_corner), hn::Set(di, 1 << (plane_shift - 1))),
                 di, planes.offsets + row * width + i);
    }
  }
}

// --- The heights of points
// -------------------------------------------------------------------------

#if HWY_TARGET == HWY_SCALAR

/// Computes the heights of up to sixteen points of two cells, with sides unless `half_bit` is
/// `no_sides`. Cells are columns of the block.
void measure_pair(const CellPair& cells, int half_bit, std::size_t pair, HeightBlock& block) {
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t row = 0; row < block_rows; ++row) {
      std::int16_t& height = block[row * tile_cells + 2 * pair + side];
      height = no_height;
      if (row >= cells.points[side].size()) continue;
      const PackedPoint point = cells.points[side][row];
      const std::int32_t x = static_cast<std::int32_t>(point & 0xFFU);
      const std::int32_t y = static_cast<std::int32_t>(point >> 8U & 0xFFU);
      const std::int32_t slope_x = static_cast<std::int16_t>(cells.slopes[side] & 0xFFFF);
      const std::int32_t slope_y = cells.slopes[side] >> 16;
      const std::int32_t surface = (slope_x * x + slope_y * y + cells.offsets[side]) >> plane_shift;
      std::int32_t above = (static_cast<std::int32_t>(point) >> 16) - surface;
      if (half_bit != no_sides) {
        above =
            above * (1 << side_bits) + (x >> half_bit & 1) * side_x + (y >> half_bit & 1) * side_y;
      }
      height = static_cast<std::int16_t>(std::clamp<std::int32_t>(above, -32768, 32767));
    }
  }
}

void arrange(HeightBlock& /*block*/) {}

#else

/// Adds the sides of points to their heights.
HWY_INLINE IntVector with_sides(IntVector heights, IntVector points, int half_bit) {
  const IntTag di;
  const IntVector halves = hn::ShiftRightSame(points, half_bit);  // in bits 0 and 8
  const IntVector sides = hn::Or(hn::And(halves, hn::Set(di, side_x)),
                                 hn::And(hn::ShiftRight<7>(halves), hn::Set(di, side_y)));
  return hn::Or(hn::ShiftLeft<side_bits>(heights), sides);
}

/// The pairs (x, y) of packed points.
HWY_INLINE IntVector positions_of(IntVector points) {
  const hn::Repartition<std::uint8_t, IntTag> db;
  constexpr std::uint8_t zero = 0x80;
  HWY_ALIGN static constexpr std::array<std::uint8_t, 16> bytes = {
      0, zero, 1, zero, 4, zero, 5, zero, 8, zero, 9, zero, 12, zero, 13, zero};
  return hn::BitCast(
      IntTag(), hn::TableLookupBytesOr0(hn::BitCast(db, points), hn::LoadDup128(db, bytes.data())));
}

/// Computes the heights of up to one vector of points; `no_height` for elements without a point.
HWY_INLINE IntVector heights_of(std::span<const PackedPoint> points, std::size_t first,
                                std::int32_t slopes, std::int32_t offset, int half_bit) {
  const IntTag di;
  const IntVector v = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(points.data() + first));
  const IntVector along = sum_of_products(positions_of(v), hn::Set(di, slopes));
  const IntVector surface = hn::ShiftRight<plane_shift>(hn::Add(along, hn::Set(di, offset)));
  IntVector above = hn::Sub(hn::ShiftRight<16>(v), surface);
  if (half_bit != no_sides) above = with_sides(above, v, half_bit);
  const auto there = hn::Lt(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(points.size()) -
                                                             static_cast<std::int32_t>(first)));
  return hn::IfThenElse(there, above, hn::Set(di, no_height));
}

/// Computes the heights of up to sixteen points of two cells, with sides unless `half_bit` is
/// `no_sides`. Each pair of cells is a row of the block until arrange() makes cells columns.
HWY_INLINE void measure_pair(const CellPair& cells, int half_bit, std::size_t pair,
                             HeightBlock& block) {
  const IntTag di;
  auto* const to = reinterpret_cast<std::int32_t*>(block.data()) + pair * block_rows;
  for (std::size_t i = 0; i < block_rows; i += hn::Lanes(di)) {
    const auto heights = [&](std::size_t side) HWY_ATTR {
      return heights_of(cells.points[side], i, cells.slopes[side], cells.offsets[side], half_bit);
    };
    hn::StoreU(saturated_pairs(heights(0), heights(1)), di, to + i);
  }
}

/// Transposes a block of 16 x 16 pairs, with two passes of LoadInterleaved4.
HWY_INLINE void arrange(HeightBlock& block) {
  const IntTag di;
  HWY_ALIGN std::array<std::int32_t, 256> turned;
  const auto turn = [&](const std::int32_t* from, std::int32_t* to) HWY_ATTR {
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(di)) {
        IntVector v0, v1, v2, v3;
        hn::LoadInterleaved4(di, from + 64 * quarter + 4 * lane, v0, v1, v2, v3);
        std::int32_t* const there = to + 16 * quarter + lane;
        hn::StoreU(v0, di, there);
        hn::StoreU(v1, di, there + 64);
        hn::StoreU(v2, di, there + 128);
        hn::StoreU(v3, di, there + 192);
      }
    }
  };
  auto* const pairs = reinterpret_cast<std::int32_t*>(block.data());
  turn(pairs, turned.data());
  turn(turned.data(), pairs);
}

#endif

// --- Statistics, one cell per lane
// -----------------------------------------------------------------

HWY_INLINE ShortVector all(std::int16_t value) { return hn::Set(ShortTag(), value); }

/// v + 1 in the lanes of the mask, v in the others.
HWY_INLINE ShortVector count_if(ShortMask mask, ShortVector v) {
#if HWY_TARGET <= HWY_AVX3
  return hn::IfThenElse(mask, hn::Add(v, all(1)), v);
#else
  return hn::Sub(v, hn::VecFromMask(ShortTag(), mask));  // a set mask is -1
#endif
}

/// The three lowest heights of each lane, lowest first.
struct Lowest {
  HWY_INLINE Lowest() : first(all(no_height)), second(first), third(first) {}
  HWY_INLINE void add(ShortVector height) {
    const ShortVector not_first = hn::Max(first, height);
    first = hn::Min(first, height);
    const ShortVector not_second = hn::Max(second, not_first);
    second = hn::Min(second, not_first);
    third = hn::Min(third, not_second);
  }
  ShortVector first, second, third;
};

/// A window of heights around `centre`, inside the gate. The limits are outside the window.
struct Window {
  HWY_INLINE Window(ShortVector centre, ShortVector gate) {
    const ShortVector reach = all(window + 1);
    const ShortVector gate_end = hn::Add(gate, all(1));
    low = hn::Max(hn::Sub(centre, reach), hn::Neg(gate_end));
    high = hn::Min(hn::Add(centre, reach), gate_end);
  }
  [[nodiscard]] HWY_INLINE ShortMask contains(ShortVector height) const {
    return hn::And(hn::Gt(height, low), hn::Lt(height, high));
  }
  ShortVector low, high;
};

/// The nearest integers to sum / count; 0 if count is 0.
HWY_INLINE ShortVector quotient(ShortVector sum, ShortVector count) {
  const ShortTag d;
  const ShortVector divisor = hn::Max(count, all(1));
#if HWY_TARGET == HWY_SCALAR
  const hn::Rebind<std::int32_t, ShortTag> di;
  const hn::Rebind<float, ShortTag> df;
  const auto number = [&](auto v) HWY_ATTR { return hn::ConvertTo(df, hn::PromoteTo(di, v)); };
  return hn::DemoteTo(d, hn::NearestInt(hn::Div(number(sum), number(divisor))));
#else
  // Half a vector of shorts has as many lanes as a vector of floats.
  const hn::Half<ShortTag> dh;
  const hn::Rebind<std::int32_t, decltype(dh)> di;
  const hn::Rebind<float, decltype(dh)> df;
  const auto number = [&](auto v) HWY_ATTR { return hn::ConvertTo(df, hn::PromoteTo(di, v)); };
  const auto divided = [&](auto a, auto b) HWY_ATTR {
    return hn::DemoteTo(dh, hn::NearestInt(hn::Div(number(a), number(b))));
  };
  return hn::Combine(d, divided(hn::UpperHalf(dh, sum), hn::UpperHalf(dh, divisor)),
                     divided(hn::LowerHalf(sum), hn::LowerHalf(divisor)));
#endif
}

/// Sums up one vector of cells. Each cell has `rows` heights, which this function overwrites.
template <std::size_t rows>
HWY_INLINE void sum_up(std::int16_t* HWY_RESTRICT heights, ShortVector gate, std::size_t lane,
                       TileStatistics& tile) {
  const ShortTag d;
  const auto load = [&](std::size_t row)
                        HWY_ATTR { return hn::Load(d, heights + row * tile_cells); };
  const auto note = [&](ShortVector v, TileStatistics::PerCell& to)
                        HWY_ATTR { hn::Store(v, d, to.data() + lane); };

  // Points outside the observed range count as no points.
  const ShortVector bottom = hn::Neg(hn::Add(gate, all(depth_below_gate)));
  const ShortVector top = hn::Add(gate, all(height_above_gate));
  const ShortVector gate_end = hn::Add(gate, all(1));
  ShortVector seen = hn::Zero(d);
  ShortVector gated = hn::Zero(d);
  Lowest of_all;
  Lowest of_gate;
  for (std::size_t row = 0; row < rows; ++row) {
    const ShortVector height = load(row);
    const ShortMask is_seen = hn::And(hn::Gt(height, bottom), hn::Lt(height, top));
    const ShortVector h = hn::IfThenElse(is_seen, height, all(no_height));
    hn::Store(h, d, heights + row * tile_cells);
    seen = count_if(is_seen, seen);
    of_all.add(h);
    const ShortMask is_gated = hn::Lt(hn::Abs(h), gate_end);
    gated = count_if(is_gated, gated);
    of_gate.add(hn::IfThenElse(is_gated, h, all(no_height)));
  }
  note(seen, tile.seen);
  note(gated, tile.gated);

  // One or two points far below the others are reflections.
  const auto is_alone = [&](ShortVector low, ShortVector next) HWY_ATTR {
    return hn::Gt(next, hn::SaturatedAdd(low, all(reflection_gap)));
  };
  const ShortVector of_the_rest =
      hn::IfThenElse(is_alone(of_all.second, of_all.third), of_all.third, of_all.second);
  note(hn::IfThenElse(is_alone(of_all.first, of_all.second), of_the_rest, of_all.first),
       tile.bound);

  // The window starts at a low point of the gate and moves to the mean of its points.
  const ShortVector of_few = hn::IfThenElse(hn::Lt(gated, all(5)), of_gate.first, of_gate.second);
  // Without a point in the gate, any start will do.
  const ShortVector start = hn::IfThenElse(hn::Lt(gated, all(10)), of_few, of_gate.third);
  ShortVector mean = hn::Min(start, gate);
  for (int move = 0; move < 2; ++move) {
    const Window inside(mean, gate);
    ShortVector sum = hn::Zero(d);
    ShortVector count = hn::Zero(d);
    for (std::size_t row = 0; row < rows; ++row) {
      const ShortVector h = load(row);
      const ShortMask is_inside = inside.contains(h);
      sum = hn::Add(sum, hn::IfThenElseZero(is_inside, hn::Sub(h, mean)));
      count = count_if(is_inside, count);
    }
    note(mean, tile.mean);
    note(sum, tile.sum);
    note(count, tile.count);
    mean = hn::Add(mean, quotient(sum, count));
  }

  const Window inside(mean, gate);
  ShortVector at_surface = hn::Zero(d);
  ShortVector above = hn::Zero(d);
  ShortVector below = hn::Zero(d);
  const ShortVector slab_low = hn::Add(mean, all(slab_bottom));
  const ShortVector slab_high = hn::Add(mean, all(slab_top));
  const ShortVector too_low = hn::Sub(mean, all(below_window));
  const ShortVector gate_below = hn::Neg(gate_end);
  for (std::size_t row = 0; row < rows; ++row) {
    const ShortVector h = load(row);
    at_surface = count_if(inside.contains(h), at_surface);
    above = count_if(hn::And(hn::Gt(h, slab_low), hn::Lt(h, slab_high)), above);
    below = count_if(hn::And(hn::Gt(h, gate_below), hn::Lt(h, too_low)), below);
  }
  note(at_surface, tile.at_surface);
  note(above, tile.above);
  note(below, tile.below);
}

// --- Slopes in cells
// -------------------------------------------------------------------------------

/// The lowest point of one half of each cell, in heights without their sides.
struct HalfCell {
  HWY_INLINE HalfCell() : lowest(all(most_with_sides)), count(hn::Zero(ShortTag())) {}
  HWY_INLINE void add(ShortMask inside, ShortVector height) {
    lowest = hn::Min(lowest, hn::IfThenElse(inside, height, all(most_with_sides)));
    count = count_if(inside, count);
  }
  ShortVector lowest, count;
};

/// Slope from one half of a cell to the other, in the units of CellPlanes.
HWY_INLINE ShortVector slope_between(const HalfCell& from, const HalfCell& to, int half_bit) {
  const int shift = plane_shift - half_bit;
  const ShortVector most = all(static_cast<std::int16_t>(static_cast<int>(most_slope) >> shift));
  const ShortMask known = hn::Gt(hn::Min(from.count, to.count), all(fewest_in_half - 1));
  const ShortVector rise = hn::IfThenElseZero(known, hn::Sub(to.lowest, from.lowest));
  return hn::ShiftLeftSame(hn::Max(hn::Min(rise, most), hn::Neg(most)), shift);
}

/// Slopes of 32 cells.
struct alignas(64) TileSlopes {
  TileStatistics::PerCell x, y;
};

/// Finds the slopes in one vector of cells from `rows` heights with sides.
template <std::size_t rows>
HWY_INLINE void find_slopes(const std::int16_t* HWY_RESTRICT heights, ShortVector gate,
                            int half_bit, std::size_t lane, TileSlopes& slopes) {
  const ShortTag d;
  const ShortVector bottom =
      hn::Max(hn::Neg(hn::Add(gate, all(depth_below_gate))), all(-most_with_sides));
  const ShortVector top = hn::Min(hn::Add(gate, all(height_above_gate)), all(most_with_sides));
  HalfCell left, right, lower, upper;
  for (std::size_t row = 0; row < rows; ++row) {
    const ShortVector v = hn::Load(d, heights + row * tile_cells);
    const ShortVector height = hn::ShiftRight<side_bits>(v);
    const ShortMask seen = hn::And(hn::Gt(height, bottom), hn::Lt(height, top));
    const ShortMask in_x = hn::TestBit(v, all(side_x));
    const ShortMask in_y = hn::TestBit(v, all(side_y));
    left.add(hn::AndNot(in_x, seen), height);
    right.add(hn::And(in_x, seen), height);
    lower.add(hn::AndNot(in_y, seen), height);
    upper.add(hn::And(in_y, seen), height);
  }
  hn::Store(slope_between(left, right, half_bit), d, slopes.x.data() + lane);
  hn::Store(slope_between(lower, upper, half_bit), d, slopes.y.data() + lane);
}

/// Adds a slope to the plane of a cell that contains `point`. The height at the centre of the cell
/// remains.
void tilt(std::int32_t slope_x, std::int32_t slope_y, PackedPoint point, int half_bit,
          std::int32_t& slopes, std::int32_t& offset) {
  const auto sum = [](std::int32_t a, std::int32_t b) {
    constexpr auto most = static_cast<std::int32_t>(most_slope);
    return std::clamp(a + b, -most, most);
  };
  const auto centre = [&](std::uint32_t coordinate) {
    const std::uint32_t half = 1U << static_cast<unsigned>(half_bit);
    return static_cast<std::int32_t>((coordinate & (0x100U - 2 * half)) + half);
  };
  const std::int32_t old_x = static_cast<std::int16_t>(slopes & 0xFFFF);
  const std::int32_t old_y = slopes >> 16;
  const std::int32_t x = sum(old_x, slope_x);
  const std::int32_t y = sum(old_y, slope_y);
  slopes = (x & 0xFFFF) | y * 65536;
  offset -= (x - old_x) * centre(point) + (y - old_y) * centre(point >> 8U);
}

// --- Observations
// ----------------------------------------------------------------------------------

/// Corrections and weights of 32 cells.
struct TileObservations {
  std::array<float, tile_cells> corrections, weights;
  std::uint32_t unclear = 0;  ///< a bit for each cell that needs a second look
};

template <Look look>
void conclude(const Observations& o, const TileStatistics& tile,
              const std::array<std::int16_t, tile_cells>& gates, TileObservations& found) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::int16_t, FloatTag> ds;
  const FloatVector one = hn::Set(d, 1.0f);
  const FloatVector metre = hn::Set(d, 1.0f / z_per_metre);
  for (std::size_t lane = 0; lane < tile_cells; lane += hn::Lanes(d)) {
    const auto number = [&](const TileStatistics::PerCell& of) HWY_ATTR {
      return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(ds, of.data() + lane)));
    };
    const auto at_least = [&](FloatVector v, float limit)
                              HWY_ATTR { return hn::Ge(v, hn::Set(d, limit)); };
    const FloatVector at_surface = number(tile.at_surface);
    const FloatVector gated = number(tile.gated);
    const FloatVector bound = number(tile.bound);
    const auto has_mode =
        hn::And(at_least(gated, fewest_points), at_least(at_surface, fewest_points));
    const float most_above = look == Look::first
                                 ? o.max_clutter_ratio
                                 : std::min(o.max_clutter_ratio, second_clutter_ratio);
    const auto has_obstacle =
        hn::Gt(number(tile.above), hn::Mul(hn::Set(d, most_above), at_surface));
    const auto few_below = hn::Le(number(tile.below), hn::Mul(hn::Set(d, most_below), at_surface));
    auto is_mode = hn::And(hn::AndNot(has_obstacle, has_mode), few_below);
    auto is_bound = hn::FirstN(d, 0);
    if constexpr (look == Look::first) {
      const FloatVector gate = number(gates);
      const auto few_gated = hn::Lt(gated, hn::Set(d, fewest_points));
      const auto beside_obstacle = hn::And(has_mode, has_obstacle);
      const auto only_below = hn::And(few_gated, hn::Lt(bound, hn::Neg(gate)));
      is_bound = hn::And(hn::And(hn::Or(only_below, beside_obstacle),
                                 at_least(number(tile.seen), fewest_for_lower_bound)),
                         hn::Lt(bound, hn::Set(d, -least_lowering)));
      const FloatVector wide_gate = hn::Add(gate, hn::Set(d, static_cast<float>(o.widening)));
      const auto in_wide_gate = hn::And(hn::Gt(bound, hn::Neg(gate)), hn::Le(bound, wide_gate));
      const auto unclear =
          o.second_look == SecondLook::tilted ? beside_obstacle : hn::And(few_gated, in_wide_gate);
      found.unclear |= bits_of(d, unclear) << lane;
    } else {
      const FloatVector share = hn::Mul(hn::Set(d, least_share), number(tile.seen));
      is_mode = hn::And(is_mode, hn::Ge(at_surface, share));
    }

    const FloatVector mean =
        hn::Add(number(tile.mean), hn::Div(number(tile.sum), hn::Max(number(tile.count), one)));
    const FloatVector mode_weight =
        hn::Min(one, hn::Mul(at_surface, hn::Set(d, 1 / points_of_full_weight)));
    const FloatVector bound_weight = hn::IfThenElseZero(is_bound, hn::Set(d, o.lower_bound_weight));
    hn::StoreU(hn::IfThenElse(is_mode, mode_weight, bound_weight), d, found.weights.data() + lane);
    hn::StoreU(hn::Mul(hn::IfThenElse(is_mode, mean, bound), metre), d,
               found.corrections.data() + lane);
  }
}

/// Writes the observations of a tile of cells into the grid, and the unclear cells to `unclear`.
/// Returns the number of unclear cells.
std::size_t write(const Observations& o, const OccupiedCells& cells, const TileObservations& found,
                  OccupiedCell* unclear) {
  for (std::size_t i = 0; i < cells.size; ++i) {
    o.corrections[cells.places[i]] = found.corrections[i];
    o.weights[cells.places[i]] = found.weights[i];
  }
  std::size_t count = 0;
  for (std::uint32_t bits = found.unclear; bits != 0; bits &= bits - 1) {
    unclear[count++] = cells[static_cast<std::size_t>(std::countr_zero(bits))];
  }
  return count;
}

/// Points of a cell for up to rows_of(size) rows: all, or a sample in `sample`.
template <CellSize size>
HWY_INLINE std::span<const PackedPoint> rows_of_cell(const Observations& o,
                                                     const OccupiedCell& cell,
                                                     PackedPoint* sample) {
  const PackedPoint* const points = o.points + cell.first;
  if constexpr (size != CellSize::large) return {points, cell.count};
  return {sample, take_sample(points, cell.count, sample_size, sample)};
}

/// Memory for a sample.
using Sample = std::array<PackedPoint, medium_cell + 3 * lanes>;

/// Measures two cells in all blocks.
template <std::size_t block_count>
HWY_INLINE void measure_cells(const Observations& o, const CellPair& cells, int half_bit,
                              std::size_t pair, std::array<HeightBlock, block_count>& blocks) {
  for (std::size_t block = 0; block < block_count; ++block) {
    CellPair rest = cells;
    for (std::span<const PackedPoint>& points : rest.points) {
      const std::size_t first = block * block_rows;
      points = points.size() > first ? points.subspan(first) : std::span(o.points, 0);
    }
    measure_pair(rest, half_bit, pair, blocks[block]);
  }
}

template <std::size_t block_count>
HWY_INLINE void sum_up_tile(std::array<HeightBlock, block_count>& blocks,
                            const std::array<std::int16_t, tile_cells>& gates,
                            TileStatistics& tile) {
  const ShortTag d;
  for (std::size_t lane = 0; lane < tile_cells; lane += hn::Lanes(d)) {
    sum_up<block_count * block_rows>(blocks[0].data() + lane, hn::Load(d, gates.data() + lane),
                                     lane, tile);
  }
}

/// Observes up to 32 cells.
template <CellSize size>
HWY_INLINE void observe_tile(const Observations& o, const OccupiedCells& cells,
                             TileObservations& found) {
  HWY_ALIGN std::array<HeightBlock, rows_of(size) / block_rows> blocks;
  HWY_ALIGN std::array<std::int16_t, tile_cells> gates{};
  HWY_ALIGN std::array<Sample, 2> samples;
  for (std::size_t pair = 0; pair < tile_cells / 2; ++pair) {
    CellPair two;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t i = 2 * pair + side;
      if (i >= cells.size) continue;
      const OccupiedCell cell = cells[i];
      gates[i] = o.gates[cell.place];
      two.slopes[side] = o.planes.slopes[cell.place];
      two.offsets[side] = o.planes.offsets[cell.place];
      two.points[side] = rows_of_cell<size>(o, cell, samples[side].data());
    }
    measure_cells(o, two, no_sides, pair, blocks);
  }
  for (HeightBlock& block : blocks) arrange(block);
  TileStatistics tile;
  sum_up_tile(blocks, gates, tile);
  conclude<Look::first>(o, tile, gates, found);
}

template <CellSize size>
std::size_t observe_tiles(const Observations& o, const OccupiedCells& cells,
                          OccupiedCell* unclear) {
  std::size_t count = 0;
  for (std::size_t begin = 0; begin < cells.size; begin += tile_cells) {
    const OccupiedCells tile = cells.part(begin, tile_cells);
    TileObservations found;
    observe_tile<size>(o, tile, found);
    count += write(o, tile, found, unclear + count);
  }
  return count;
}

/// Observes up to 32 cells of any size a second time.
template <Look look>
HWY_INLINE void observe_tile_again(const Observations& o, std::span<const OccupiedCell> cells,
                                   TileObservations& found) {
  const ShortTag d;
  constexpr std::size_t rows = medium_cell;
  HWY_ALIGN std::array<HeightBlock, rows / block_rows> blocks;
  HWY_ALIGN std::array<std::int16_t, tile_cells> gates{};
  HWY_ALIGN std::array<Sample, tile_cells> samples;
  std::array<CellPair, tile_cells / 2> pairs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const OccupiedCell& cell = cells[i];
    gates[i] = o.gates[cell.place];
    if constexpr (look == Look::wide) gates[i] = static_cast<std::int16_t>(gates[i] + o.widening);
    CellPair& two = pairs[i / 2];
    two.slopes[i % 2] = o.planes.slopes[cell.place];
    two.offsets[i % 2] = o.planes.offsets[cell.place];
    two.points[i % 2] = cell.count > rows
                            ? rows_of_cell<CellSize::large>(o, cell, samples[i].data())
                            : rows_of_cell<CellSize::medium>(o, cell, nullptr);
  }
  const auto measure = [&](int half_bit) HWY_ATTR {
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
      measure_cells(o, pairs[pair], half_bit, pair, blocks);
    }
    for (HeightBlock& block : blocks) arrange(block);
  };
  if constexpr (look == Look::tilted) {
    measure(o.half_bit);
    TileSlopes slopes;
    for (std::size_t lane = 0; lane < tile_cells; lane += hn::Lanes(d)) {
      find_slopes<rows>(blocks[0].data() + lane, hn::Load(d, gates.data() + lane), o.half_bit, lane,
                        slopes);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CellPair& two = pairs[i / 2];
      tilt(slopes.x[i], slopes.y[i], o.points[cells[i].first], o.half_bit, two.slopes[i % 2],
           two.offsets[i % 2]);
    }
  }
  measure(no_sides);
  TileStatistics tile;
  sum_up_tile(blocks, gates, tile);
  conclude<look>(o, tile, gates, found);
}

template <Look look>
void observe_tiles_again(const Observations& o, std::span<const OccupiedCell> cells,
                         Candidate* candidates) {
  for (std::size_t begin = 0; begin < cells.size(); begin += tile_cells) {
    const auto tile = cells.subspan(begin, std::min(tile_cells, cells.size() - begin));
    TileObservations found;
    observe_tile_again<look>(o, tile, found);
    for (std::size_t i = 0; i < tile.size(); ++i) {
      candidates[begin + i] = {
          .place = tile[i].place, .correction = found.corrections[i], .weight = found.weights[i]};
    }
  }
}

std::size_t observe_cells(const Observations& o, const OccupiedCells& cells, CellSize size,
                          OccupiedCell* unclear) {
  switch (size) {
    case CellSize::small: return observe_tiles<CellSize::small>(o, cells, unclear);
    case CellSize::medium: return observe_tiles<CellSize::medium>(o, cells, unclear);
    case CellSize::large: return observe_tiles<CellSize::large>(o, cells, unclear);
  }
  return 0;
}

void observe_cells_again(const Observations& o, std::span<const OccupiedCell> cells,
                         Candidate* candidates) {
  switch (o.second_look) {
    case SecondLook::tilted: return observe_tiles_again<Look::tilted>(o, cells, candidates);
    case SecondLook::wide: return observe_tiles_again<Look::wide>(o, cells, candidates);
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(find_planes_of);
HWY_EXPORT(observe_cells);
HWY_EXPORT(observe_cells_again);
}  // namespace

void find_planes(const Grid& grid, float packed_zero, const CellPlanes& planes) noexcept {
  HWY_DYNAMIC_DISPATCH(find_planes_of)(grid, packed_zero, planes);
}

std::size_t observe(const Observations& observations, const OccupiedCells& cells, CellSize size,
                    OccupiedCell* unclear) noexcept {
  return HWY_DYNAMIC_DISPATCH(observe_cells)(observations, cells, size, unclear);
}

void observe_again(const Observations& observations, std::span<const OccupiedCell> cells,
                   Candidate* candidates) noexcept {
  HWY_DYNAMIC_DISPATCH(observe_cells_again)(observations, cells, candidates);
}

}  // namespace flagstone::surface
#endif

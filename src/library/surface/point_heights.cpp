// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/point_heights.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/point_heights.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/surface/square_cells-inl.hpp"

#ifndef FLAGSTONE_SURFACE_POINT_HEIGHTS_ONCE
#define FLAGSTONE_SURFACE_POINT_HEIGHTS_ONCE
namespace flagstone::surface {

/// Points higher than this above the surface are overhanging objects, not obstacles, metres.
inline constexpr float overhang = 2.5f;

/// Marks of obstacles in cells of 0.5 m. Each cell has two bytes: the first is 1 if it contains a
/// point above `low`, the second if it contains a point above `high`.
struct ObstacleCells {
  std::uint32_t* words;  ///< two cells per word
  std::int32_t width;    ///< cells along a side
  float edge;            ///< cells from the sensor to the edge
  float low, high;       ///< metres above the surface
};

/// A chunk of points and their heights.
struct MeasuredPoints {
  const float *x, *y, *z;  ///< 16 more values must be readable
  std::size_t count;
  float* heights;
};

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

using FloatMask = hn::Mask<FloatTag>;

/// Position of a coordinate between the centres of two cells.
struct Between {
  IntVector first;    ///< index of the first cell; the second is the next one
  FloatVector share;  ///< weight of the second cell, 0 to 1
};

HWY_INLINE Between between(FloatVector coordinate, FloatVector per_cell, FloatVector middle,
                           FloatVector width) {
  const FloatTag d;
  const FloatVector one = hn::Set(d, 1.0f);
  const FloatVector center = hn::Add(hn::Mul(coordinate, per_cell), middle);
  // NaN becomes 0.
  const FloatVector inside =
      hn::Min(hn::IfThenElseZero(hn::Gt(center, hn::Zero(d)), center), hn::Sub(width, one));
  const IntVector first = whole_part(hn::Min(inside, hn::Sub(width, hn::Add(one, one))));
  return {first, hn::Sub(inside, hn::ConvertTo(d, first))};
}

HWY_INLINE FloatVector blend(FloatVector a, FloatVector b, FloatVector share_of_b) {
  return hn::Add(a, hn::Mul(share_of_b, hn::Sub(b, a)));
}

/// As blend(), but a value without weight has no influence, neither by rounding nor if it is NaN.
HWY_INLINE FloatVector blend_with_care(FloatVector a, FloatVector b, FloatVector share_of_b) {
  const FloatTag d;
  const FloatVector from_b =
      hn::IfThenElse(hn::Ge(share_of_b, hn::Set(d, 1.0f)), b, blend(a, b, share_of_b));
  return hn::IfThenElse(hn::Le(share_of_b, hn::Zero(d)), a, from_b);
}

/// The height of the surface at each point, bilinear and bit-identical to GroundSurface::height.
/// Accepts any value, including NaN, infinity and denormals, and returns a value for each.
HWY_INLINE FloatVector surface_at(FloatVector x, FloatVector y, const GridTables& tables) {
  const FloatTag d;
  const IntTag di;
  const FloatVector reach = hn::Max(hn::Abs(x), hn::Abs(y));
  IntVector grid = hn::Zero(di);
  for (std::size_t i = 1; i < tables.count; ++i) {
    const auto covers = hn::Le(reach, hn::Set(d, tables.extents[i]));
    grid = increment_if(hn::RebindMask(di, covers), grid);
  }
  const FloatVector per_cell = lookup_8(tables.per_cell.data(), grid);
  const FloatVector middle = lookup_8(tables.middles.data(), grid);
  const FloatVector width = lookup_8(tables.widths.data(), grid);
  const Between column = between(x, per_cell, middle, width);
  const Between row = between(y, per_cell, middle, width);
  // Computed in floats; all values are integers below 2^24, so they are exact.
  const FloatVector row_first =
      hn::Add(hn::Mul(hn::ConvertTo(d, row.first), width), lookup_8(tables.firsts.data(), grid));
  const IntVector near = hn::Add(whole_part(row_first), column.first);
  const IntVector far = hn::Add(near, whole_part(width));
  FloatVector near_left, near_right, far_left, far_right;
  gather_pairs(tables.heights, near, near_left, near_right);
  gather_pairs(tables.heights, far, far_left, far_right);
  const FloatVector height = blend(blend(near_left, near_right, column.share),
                                   blend(far_left, far_right, column.share), row.share);
  const FloatVector one = hn::Set(d, 1.0f);
  const auto on_last_center = hn::Or(hn::Ge(column.share, one), hn::Ge(row.share, one));
  if (HWY_LIKELY(hn::AllFalse(d, hn::Or(on_last_center, hn::IsNaN(height))))) return height;
  return blend_with_care(blend_with_care(near_left, near_right, column.share),
                         blend_with_care(far_left, far_right, column.share), row.share);
}

/// The 0.5 m cells of points within the extent. Points with `there` false get the cell next to the
/// sensor.
HWY_INLINE IntVector obstacle_cell(FloatMask there, FloatVector x, FloatVector y,
                                   const ObstacleCells& obstacles) {
  const FloatTag d;
  const IntTag di;
  const FloatVector two = hn::Set(d, 2.0f);
  const FloatVector edge = hn::Set(d, obstacles.edge);
  const IntVector column = whole_part(hn::Add(hn::IfThenElseZero(there, hn::Mul(x, two)), edge));
  const IntVector row = whole_part(hn::Add(hn::IfThenElseZero(there, hn::Mul(y, two)), edge));
  return hn::Add(hn::Mul(row, hn::Set(di, obstacles.width)), column);
}

void measure_points(const MeasuredPoints& points, const GridTables& tables,
                    const SquareCells& cells, const ObstacleCells& obstacles) {
  const FloatTag d;
  const IntTag di;
  const FloatVector unknown = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
  auto* const marks = reinterpret_cast<std::uint8_t*>(obstacles.words);
  HWY_ALIGN std::array<std::int32_t, 2 * lanes> marked;
  HWY_ALIGN std::array<float, lanes> rest;
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
    const FloatVector x = hn::LoadU(d, points.x + i);
    const FloatVector y = hn::LoadU(d, points.y + i);
    const FloatVector z = hn::LoadU(d, points.z + i);
    auto good = is_good(x, y, z, cells);
    if (HWY_UNLIKELY(i + hn::Lanes(d) > points.count)) {
      good = hn::And(good, hn::FirstN(d, points.count - i));
    }
    const FloatVector height = hn::IfThenElse(good, hn::Sub(z, surface_at(x, y, tables)), unknown);
    if (HWY_LIKELY(i + hn::Lanes(d) <= points.count)) {
      hn::StoreU(height, d, points.heights + i);
    } else {
      hn::Store(height, d, rest.data());
      std::copy_n(rest.data(), points.count - i, points.heights + i);
    }
    const auto is_obstacle =
        hn::And(hn::Gt(height, hn::Set(d, obstacles.low)), hn::Lt(height, hn::Set(d, overhang)));
    if (hn::AllFalse(d, is_obstacle)) continue;
    const auto is_high = hn::RebindMask(di, hn::Gt(height, hn::Set(d, obstacles.high)));
    const IntVector byte =
        increment_if(is_high, hn::ShiftLeft<1>(obstacle_cell(is_obstacle, x, y, obstacles)));
    const std::size_t count = compress_store(byte, hn::RebindMask(di, is_obstacle), marked.data());
    for (std::size_t k = 0; k < count; ++k) {
      // Other threads may set the same mark.
      std::atomic_ref<std::uint8_t>(marks[marked[k]]).store(1, std::memory_order_relaxed);
    }
  }
}

void label_points(const MeasuredPoints& points, const PointRule& rule, const SquareCells& cells,
                  const ObstacleCells& obstacles, std::uint8_t* labels,
                  std::array<std::size_t, label_count>& totals) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::uint8_t, FloatTag> d8;
  const auto label_lanes = [&](Label label)
                               HWY_ATTR { return hn::Set(di, static_cast<std::int32_t>(label)); };
  std::size_t ground_count = 0;
  std::size_t noise_count = 0;
  std::size_t far_count = 0;
  std::size_t invalid_count = 0;
  HWY_ALIGN std::array<std::uint8_t, lanes> rest;
  HWY_ALIGN std::array<float, lanes> last_heights{};
  const float middle_margin = (rule.margin + rule.obstacle_margin) / 2;
  for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
    const bool whole = i + hn::Lanes(d) <= points.count;
    const FloatVector x = hn::LoadU(d, points.x + i);
    const FloatVector y = hn::LoadU(d, points.y + i);
    const FloatVector z = hn::LoadU(d, points.z + i);
    FloatVector height;
    if (HWY_LIKELY(whole)) {
      height = hn::LoadU(d, points.heights + i);
    } else {
      std::copy_n(points.heights + i, points.count - i, last_heights.data());
      height = hn::Load(d, last_heights.data());
    }
    auto there = hn::FirstN(d, lanes);
    if (HWY_UNLIKELY(!whole)) there = hn::FirstN(d, points.count - i);
    const auto good = hn::And(is_good(x, y, z, cells), there);

    const IntVector cell = obstacle_cell(good, x, y, obstacles);
    const IntVector word = hn::GatherIndex(
        di, reinterpret_cast<const std::int32_t*>(obstacles.words), hn::ShiftRight<1>(cell));
    const IntVector shift = hn::ShiftLeft<4>(hn::And(cell, hn::Set(di, 1)));
    const IntVector bytes = hn::And(hn::Shr(word, shift), hn::Set(di, 0x101));
    FloatVector margin = hn::IfThenElse(hn::RebindMask(d, hn::Eq(bytes, hn::Zero(di))),
                                        hn::Set(d, rule.margin), hn::Set(d, middle_margin));
    margin = hn::IfThenElse(hn::RebindMask(d, hn::Gt(bytes, hn::Set(di, 1))),
                            hn::Set(d, rule.obstacle_margin), margin);
    const FloatVector range = hn::Sqrt(hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const FloatVector deepest = hn::Neg(hn::Add(
        hn::Set(d, rule.noise_depth), hn::Mul(hn::Set(d, rule.noise_depth_per_metre), range)));
    const FloatVector lowest =
        hn::Sub(hn::Set(d, cells.noise_height()), hn::Mul(hn::Set(d, cells.noise_slope()), range));
    const auto noise = hn::And(good, hn::Or(hn::Le(height, deepest), hn::Lt(z, lowest)));
    const auto ground = hn::AndNot(noise, hn::And(good, hn::Lt(height, margin)));

    IntVector label = hn::IfThenElseZero(hn::RebindMask(di, ground), label_lanes(Label::ground));
    label = hn::IfThenElse(hn::RebindMask(di, noise), label_lanes(Label::noise), label);
    ground_count += hn::CountTrue(d, ground);
    noise_count += hn::CountTrue(d, noise);
    if (HWY_UNLIKELY(!hn::AllTrue(d, good))) {
      const auto bad = hn::AndNot(good, there);
      const auto valid = hn::And(is_valid(x, y, z), bad);
      const auto invalid = hn::AndNot(valid, bad);
      label = hn::IfThenElse(hn::RebindMask(di, valid), label_lanes(Label::out_of_range), label);
      label = hn::IfThenElse(hn::RebindMask(di, invalid), label_lanes(Label::invalid), label);
      far_count += hn::CountTrue(d, valid);
      invalid_count += hn::CountTrue(d, invalid);
    }
    if (HWY_LIKELY(whole)) {
      hn::StoreU(hn::DemoteTo(d8, label), d8, labels + i);
    } else {
      hn::StoreU(hn::DemoteTo(d8, label), d8, rest.data());
      std::copy_n(rest.data(), points.count - i, labels + i);
    }
  }
  totals[static_cast<std::size_t>(Label::ground)] += ground_count;
  totals[static_cast<std::size_t>(Label::noise)] += noise_count;
  totals[static_cast<std::size_t>(Label::out_of_range)] += far_count;
  totals[static_cast<std::size_t>(Label::invalid)] += invalid_count;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(measure_points);
HWY_EXPORT(label_points);

/// Number of 0.5 m cells along one side.
std::size_t obstacle_width(const SquareCells& cells) {
  return static_cast<std::size_t>(4 * cells.extent());
}

/// The two limits are a quarter below and a quarter above `height`.
ObstacleCells obstacle_cells(const SquareCells& cells, std::uint32_t* words, float height) {
  return {.words = words,
          .width = static_cast<std::int32_t>(obstacle_width(cells)),
          .edge = 2 * cells.extent(),
          .low = 0.75f * height,
          .high = 1.25f * height};
}

MeasuredPoints chunk_of(const plane_fits::ScanPoints& scan, std::size_t chunk, std::size_t points,
                        float* heights) {
  const std::size_t begin = chunk * plane_fits::chunk_size;
  return {.x = scan.x() + begin,
          .y = scan.y() + begin,
          .z = scan.z() + begin,
          .count = std::min(plane_fits::chunk_size, points - begin),
          .heights = heights + begin};
}

}  // namespace

PointHeights::PointHeights(const SurfaceConfig& config, const SquareCells& cells)
    : cells_(&cells), rule_(config.point) {
  const std::size_t width = obstacle_width(cells);
  obstacle_words_ = width * width / 2 + 1;
  obstacles_.reserve(obstacle_words_);
}

void PointHeights::set_surface(std::span<const Grid> grids) noexcept {
  std::fill_n(obstacles_.data(), obstacle_words_, 0);
  tables_.count = grids.size();
  tables_.heights = grids.front().heights;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const Grid& grid = grids[i];
    const auto width = static_cast<float>(grid.width);
    const bool inner = grid.extent() < grids.front().extent();
    tables_.extents[i] = inner ? grid.extent() - grid.cell / 2 : grid.extent();
    tables_.per_cell[i] = 1 / grid.cell;
    tables_.middles[i] = (width - 1) / 2;
    tables_.widths[i] = width;
    tables_.firsts[i] = static_cast<float>(grid.heights - tables_.heights);
  }
}

void PointHeights::measure(const plane_fits::ScanPoints& scan, std::size_t chunk,
                           std::span<float> heights) noexcept {
  HWY_DYNAMIC_DISPATCH(measure_points)
  (chunk_of(scan, chunk, heights.size(), heights.data()), tables_, *cells_,
   obstacle_cells(*cells_, obstacles_.data(), rule_.obstacle_height));
}

void PointHeights::label(const plane_fits::ScanPoints& scan, std::size_t chunk,
                         std::span<float> heights, std::span<Label> labels,
                         LabelTotals& totals) noexcept {
  HWY_DYNAMIC_DISPATCH(label_points)
  (chunk_of(scan, chunk, heights.size(), heights.data()), rule_, *cells_,
   obstacle_cells(*cells_, obstacles_.data(), rule_.obstacle_height),
   reinterpret_cast<std::uint8_t*>(labels.data()) + chunk * plane_fits::chunk_size, totals);
}

}  // namespace flagstone::surface
#endif

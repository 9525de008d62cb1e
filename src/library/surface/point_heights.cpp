// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/point_heights.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/point_heights.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/read_cloud-inl.hpp"
#include "library/surface/square_cells-inl.hpp"

#ifndef FLAGSTONE_SURFACE_POINT_HEIGHTS_ONCE
#define FLAGSTONE_SURFACE_POINT_HEIGHTS_ONCE
namespace flagstone::surface {

/// Points higher than this above the surface are overhanging objects, not obstacles, metres.
inline constexpr float overhang = 2.5f;

/// Marks of obstacles in cells of 0.5 m. Each cell has two bytes: the first is `mark` if it
/// contains a point above `low`, the second if it contains a point above `high`.
struct ObstacleCells {
  std::uint8_t* marks;
  std::uint8_t mark;   ///< of this scan
  std::int32_t width;  ///< cells along a side
  float edge;          ///< cells from the sensor to the edge
  float low, high;     ///< metres above the surface
};

/// Data for all points of a scan.
struct MeasuredScan {
  CloudView cloud;
  const std::uint8_t* unusual;  ///< see PackedPoints::unusual
  const GridTables& tables;
  const SquareCells& cells;
  const ObstacleCells& obstacles;
  const PointRule& rule;
};

/// Where to write the results of consecutive points, and the points without a final label.
struct MeasuredSlice {
  std::size_t begin, end;           ///< points of the cloud
  float* heights;                   ///< of point `begin`
  std::uint8_t* labels;             ///< of point `begin`
  std::uint32_t* undecided_points;  ///< 16 more than points can be written
  std::uint32_t* undecided_cells;   ///< 16 more than points can be written
};

/// Points whose cells of the surface are looked up together. Their intermediate results stay in the
/// first-level cache.
inline constexpr std::size_t lookup_size = 512;

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
                           FloatVector last, bool reaches_edge) {
  const FloatTag d;
  FloatVector centre = hn::Add(hn::Mul(coordinate, per_cell), middle);
  if (HWY_UNLIKELY(reaches_edge)) {
    centre = hn::Min(hn::Max(centre, hn::Zero(d)), last);
    const IntVector first = whole_part(hn::Min(centre, hn::Sub(last, hn::Set(d, 1.0f))));
    return {first, hn::Sub(centre, hn::ConvertTo(d, first))};
  }
  const IntVector first = whole_part(centre);
  return {first, hn::Sub(centre, hn::ConvertTo(d, first))};
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

/// The four heights of the surface around a position, and the weights of the second ones.
struct Square {
  IntVector near, far;  ///< index of the first of two heights in each row
  FloatVector share_x, share_y;
};

/// Finds the squares around points within the extent.
class SquareFinder {
 public:
  HWY_INLINE explicit SquareFinder(const GridTables& tables)
      : tables_(tables),
        per_cell_(tables.per_cell.data()),
        middles_(tables.middles.data()),
        strides_(reinterpret_cast<const float*>(tables.strides.data())),
        firsts_(reinterpret_cast<const float*>(tables.firsts.data())) {}

  HWY_INLINE Square at(FloatVector x, FloatVector y) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector reach = hn::Max(hn::Abs(x), hn::Abs(y));
    IntVector grid = hn::Zero(di);
    for (std::size_t i = 1; i < tables_.count; ++i) {
      const auto covers = hn::Le(reach, hn::Set(d, tables_.extents[i]));
      grid = increment_if(hn::RebindMask(di, covers), grid);
    }
    const FloatVector per_cell = per_cell_[grid];
    const FloatVector middle = middles_[grid];
    const bool reaches_edge = tables_.reaches_edge;
    const FloatVector last = reaches_edge ? lookup_8(tables_.last.data(), grid) : hn::Zero(d);
    const Between column = between(x, per_cell, middle, last, reaches_edge);
    const Between row = between(y, per_cell, middle, last, reaches_edge);
    const IntVector strides = hn::BitCast(di, strides_[grid]);
    const IntVector place = hn::Or(column.first, hn::ShiftLeft<16>(row.first));
    const IntVector near = hn::Add(hn::BitCast(di, firsts_[grid]), sum_of_products(place, strides));
    return {near, hn::Add(near, hn::ShiftRight<16>(strides)), column.share, row.share};
  }

 private:
  const GridTables& tables_;
  Table8 per_cell_, middles_;
  Table8 strides_, firsts_;  ///< integers
};

/// The 0.5 m cells of points within the extent.
HWY_INLINE IntVector obstacle_cell(FloatVector x, FloatVector y, const ObstacleCells& obstacles) {
  const FloatTag d;
  const IntTag di;
  const FloatVector two = hn::Set(d, 2.0f);
  const FloatVector edge = hn::Set(d, obstacles.edge);
  const IntVector column = whole_part(hn::Add(hn::Mul(x, two), edge));
  const IntVector row = whole_part(hn::Add(hn::Mul(y, two), edge));
  return sum_of_products(hn::Or(column, hn::ShiftLeft<16>(row)),
                         hn::Set(di, 1 | obstacles.width << 16));
}

/// Intermediate results of up to `lookup_size` points.
struct alignas(64) Lookups {
  template <class T>
  using PerPoint = std::array<T, lookup_size>;

  PerPoint<float> share_x, share_y;
  PerPoint<float> z;  ///< NaN for points that are invalid or out of range
  PerPoint<float> squared_range;
  PerPoint<std::int32_t> obstacle_cell;
  PerPoint<std::int32_t> code;  ///< label of points without a height, and of noise below all cells
  std::array<std::uint8_t, lookup_size> has_code;  ///< per vector: whether any point has a code

  /// Per vector: where the square of the surface differs from that of the point before.
  std::array<std::uint16_t, lookup_size> starts;
  /// The squares, one per start.
  std::array<std::int32_t, lookup_size + lanes> near, far;
  std::size_t squares = 0;
  /// Pairs of heights of each square.
  std::array<float, 2 * (lookup_size + lanes)> near_pairs, far_pairs;
};

/// The code of points that have none.
inline constexpr std::int32_t no_code = -1;

HWY_INLINE IntVector code_of(Label label) {
  return hn::Set(IntTag(), static_cast<std::int32_t>(label));
}

/// Finds the squares of the surface around points.
class FindSquares {
 public:
  /// For points from `begin` on.
  HWY_INLINE FindSquares(const MeasuredScan& scan, std::size_t begin, Lookups& lookups)
      : scan_(scan),
        unusual_(scan.unusual + begin / 4),
        lookups_(lookups),
        squares_(scan.tables),
        previous_(hn::Set(IntTag(), -1)) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) {
    const FloatTag d;
    const IntTag di;
    const std::size_t vector = i / hn::Lanes(d);
    const FloatVector squared_range = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
    hn::Store(squared_range, d, lookups_.squared_range.data() + i);
    lookups_.has_code[vector] = unusual_[i / 4];
    if (HWY_UNLIKELY(unusual_[i / 4] != 0)) {
      const auto good = is_good(x, y, z, scan_.cells);
      const auto too_low = hn::And(good, is_below_cells(squared_range, z, scan_.cells));
      const IntVector bad = hn::IfThenElse(hn::RebindMask(di, is_valid(x, y, z)),
                                           code_of(Label::out_of_range), code_of(Label::invalid));
      const IntVector low =
          hn::IfThenElse(hn::RebindMask(di, too_low), code_of(Label::noise), hn::Set(di, no_code));
      hn::Store(hn::IfThenElse(hn::RebindMask(di, good), low, bad), di, lookups_.code.data() + i);
      x = hn::IfThenElseZero(good, x);
      y = hn::IfThenElseZero(good, y);
      z = hn::IfThenElse(good, z, hn::Set(d, std::numeric_limits<float>::quiet_NaN()));
    }
    hn::Store(z, d, lookups_.z.data() + i);
    hn::Store(obstacle_cell(x, y, scan_.obstacles), di, lookups_.obstacle_cell.data() + i);

    const Square square = squares_.at(x, y);
    hn::Store(square.share_x, d, lookups_.share_x.data() + i);
    hn::Store(square.share_y, d, lookups_.share_y.data() + i);
    const auto starts = hn::Ne(square.near, move_up(square.near, previous_));
    previous_ = square.near;
    compress_store(square.far, starts, lookups_.far.data() + lookups_.squares);
    lookups_.squares +=
        compress_store(square.near, starts, lookups_.near.data() + lookups_.squares);
    lookups_.starts[vector] = static_cast<std::uint16_t>(bits_of(di, starts));
  }

 private:
  const MeasuredScan& scan_;
  const std::uint8_t* unusual_;
  Lookups& lookups_;
  SquareFinder squares_;
  IntVector previous_;  ///< squares of the previous vector, -1 before the first
};

/// Reads the heights of the squares. Neighbours in the cloud often share a square, so this takes
/// less time than reading them for every point.
HWY_INLINE void look_up(const GridTables& tables, Lookups& lookups) {
  for (std::size_t i = 0; i < lookups.squares; ++i) {
    std::memcpy(lookups.near_pairs.data() + 2 * i, tables.heights + lookups.near[i],
                2 * sizeof(float));
    std::memcpy(lookups.far_pairs.data() + 2 * i, tables.heights + lookups.far[i],
                2 * sizeof(float));
  }
}

/// The height of the surface at the points of a vector, bit-identical to GroundSurface::height.
/// Their squares are consecutive from `first`; `starts` has a bit for each point with a new square.
HWY_INLINE FloatVector surface_at(const Lookups& lookups, std::size_t i, std::size_t first,
                                  std::uint32_t starts, bool reaches_edge) {
  const FloatTag d;
  const IntVector left = hn::ShiftLeft<1>(ranks_of(starts | 1U));
  const IntVector right = hn::Or(left, hn::Set(IntTag(), 1));
  const float* const near = lookups.near_pairs.data() + 2 * first;
  const float* const far = lookups.far_pairs.data() + 2 * first;
  const FloatVector share_x = hn::Load(d, lookups.share_x.data() + i);
  const FloatVector share_y = hn::Load(d, lookups.share_y.data() + i);
  const FloatVector near_left = lookup_in_two(near, left);
  const FloatVector near_right = lookup_in_two(near, right);
  const FloatVector far_left = lookup_in_two(far, left);
  const FloatVector far_right = lookup_in_two(far, right);
  const FloatVector height =
      blend(blend(near_left, near_right, share_x), blend(far_left, far_right, share_x), share_y);
  if (HWY_LIKELY(!reaches_edge && hn::AllFalse(d, hn::IsNaN(height)))) return height;
  return blend_with_care(blend_with_care(near_left, near_right, share_x),
                         blend_with_care(far_left, far_right, share_x), share_y);
}

/// Limits of heights above the surface, metres.
struct Limits {
  HWY_INLINE Limits(const PointRule& rule, const ObstacleCells& obstacles)
      : least_margin(hn::Set(FloatTag(), std::min(rule.margin, rule.obstacle_margin))),
        most_margin(hn::Set(FloatTag(), std::max(rule.margin, rule.obstacle_margin))),
        noise(hn::Set(FloatTag(), -rule.noise_depth)),
        low(hn::Set(FloatTag(), obstacles.low)),
        high(hn::Set(FloatTag(), obstacles.high)),
        overhanging(hn::Set(FloatTag(), overhang)) {}
  FloatVector least_margin, most_margin;  ///< that the obstacles around a point can lead to
  FloatVector noise;                      ///< points above this are not noise
  FloatVector low, high, overhanging;     ///< of obstacles
};

/// Numbers of points.
struct Counts {
  std::size_t ground = 0;
  std::size_t noise = 0;
  std::size_t out_of_range = 0;
  std::size_t invalid = 0;
  std::size_t undecided = 0;
  std::size_t marked = 0;  ///< listed marks
};

/// Computes heights and labels.
class LabelPoints {
 public:
  HWY_INLINE LabelPoints(const MeasuredScan& scan, const MeasuredSlice& slice)
      : scan_(scan), slice_(slice) {}

  /// Labels `count` points, beginning with point `begin` of the slice.
  HWY_INLINE void label(Lookups& lookups, std::size_t begin, std::size_t count) {
    const FloatTag d;
    const bool reaches_edge = scan_.tables.reaches_edge;
    const Limits limits(scan_.rule, scan_.obstacles);
    Counts counts = counts_;  // a local copy stays in registers
    std::size_t squares = 0;  // that begin before the vector
    std::size_t i = 0;
    const auto next_heights = [&] HWY_ATTR {
      const std::uint32_t starts = lookups.starts[i / hn::Lanes(d)];
      // If the first point starts no square, it uses the last one before.
      const FloatVector surface =
          surface_at(lookups, i, squares - 1 + (starts & 1U), starts, reaches_edge);
      squares += static_cast<std::size_t>(std::popcount(starts));
      return hn::Sub(hn::Load(d, lookups.z.data() + i), surface);
    };
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
      const FloatVector height = next_heights();
      const IntVector label = label_vector(lookups, i, begin, height, limits, counts);
      hn::StoreU(height, d, slice_.heights + begin + i);
      hn::StoreU(hn::DemoteTo(d8, label), d8, slice_.labels + begin + i);
    }
    if (i < count) label_rest(lookups, i, begin, next_heights(), count - i, limits, counts);
    set_marks(counts.marked);
    counts.marked = 0;
    counts_ = counts;
  }

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  using ByteTag = hn::Rebind<std::uint8_t, FloatTag>;
  static constexpr ByteTag d8{};

  /// The labels of a vector. Points with an unknown height are `nonground`, unless they have a
  /// code.
  HWY_INLINE IntVector label_vector(const Lookups& lookups, std::size_t i, std::size_t begin,
                                    FloatVector height, const Limits& limits, Counts& counts) {
    const FloatTag d;
    const IntTag di;
    const IntVector cell = hn::Load(di, lookups.obstacle_cell.data() + i);
    mark(height, cell, limits, counts);

    const auto below_least = hn::Lt(height, limits.least_margin);
    auto undecided =
        hn::And(hn::Ge(height, limits.least_margin), hn::Lt(height, limits.most_margin));
    IntVector label = hn::IfThenElseZero(hn::RebindMask(di, below_least), code_of(Label::ground));
    counts.ground += hn::CountTrue(d, below_least);
    const auto may_be_noise = hn::Le(height, limits.noise);
    if (HWY_UNLIKELY(!hn::AllFalse(d, may_be_noise))) {
      const FloatVector range = hn::Sqrt(hn::Load(d, lookups.squared_range.data() + i));
      const FloatVector deepest =
          hn::Sub(limits.noise, hn::Mul(hn::Set(d, scan_.rule.noise_depth_per_metre), range));
      const auto noise = hn::Le(height, deepest);
      label = hn::IfThenElse(hn::RebindMask(di, noise), code_of(Label::noise), label);
      counts.ground -= hn::CountTrue(d, hn::And(noise, below_least));
      counts.noise += hn::CountTrue(d, noise);
    }
    if (HWY_UNLIKELY(lookups.has_code[i / hn::Lanes(d)] != 0)) {
      const IntVector code = hn::Load(di, lookups.code.data() + i);
      const auto has_code = hn::Ne(code, hn::Set(di, no_code));
      undecided = hn::AndNot(hn::RebindMask(d, has_code), undecided);
      const auto recount = [&](Label one, std::size_t& count) HWY_ATTR {
        const auto was = hn::And(has_code, hn::Eq(label, code_of(one)));
        const auto is = hn::And(has_code, hn::Eq(code, code_of(one)));
        count += hn::CountTrue(di, is) - hn::CountTrue(di, was);
      };
      recount(Label::ground, counts.ground);
      recount(Label::noise, counts.noise);
      recount(Label::out_of_range, counts.out_of_range);
      recount(Label::invalid, counts.invalid);
      label = hn::IfThenElse(has_code, code, label);
    }

    const auto is_undecided = hn::RebindMask(di, undecided);
    const IntVector points =
        hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(begin + i)));
    compress_store(cell, is_undecided,
                   reinterpret_cast<std::int32_t*>(slice_.undecided_cells + counts.undecided));
    counts.undecided +=
        compress_store(points, is_undecided,
                       reinterpret_cast<std::int32_t*>(slice_.undecided_points + counts.undecided));
    return label;
  }

  /// Labels the last `rest` points of a cloud. The other points of the vector get an unknown height
  /// and no code, so that they are not counted.
  HWY_INLINE void label_rest(Lookups& lookups, std::size_t i, std::size_t begin, FloatVector height,
                             std::size_t rest, const Limits& limits, Counts& counts) {
    const FloatTag d;
    const IntTag di;
    HWY_ALIGN std::array<float, lanes> heights;
    HWY_ALIGN std::array<std::uint8_t, lanes> labels;
    const FloatVector unknown = hn::Set(d, std::numeric_limits<float>::quiet_NaN());
    height = hn::IfThenElse(hn::FirstN(d, rest), height, unknown);
    std::int32_t* const codes = lookups.code.data() + i;
    hn::Store(hn::IfThenElse(hn::FirstN(di, rest), hn::Load(di, codes), hn::Set(di, no_code)), di,
              codes);
    const IntVector label = label_vector(lookups, i, begin, height, limits, counts);
    hn::Store(height, d, heights.data());
    hn::StoreU(hn::DemoteTo(d8, label), d8, labels.data());
    std::copy_n(heights.data(), rest, slice_.heights + begin + i);
    std::copy_n(labels.data(), rest, slice_.labels + begin + i);
  }

  /// Lists the marks of points on obstacles.
  HWY_INLINE void mark(FloatVector height, IntVector cell, const Limits& limits, Counts& counts) {
    const FloatTag d;
    const IntTag di;
    const auto is_obstacle =
        hn::And(hn::Gt(height, limits.low), hn::Lt(height, limits.overhanging));
    if (hn::AllFalse(d, is_obstacle)) return;
    const auto is_high = hn::RebindMask(di, hn::Gt(height, limits.high));
    const IntVector mark =
        hn::IfThenElse(hn::RebindMask(di, is_obstacle),
                       increment_if(is_high, hn::ShiftLeft<1>(cell)), hn::Set(di, no_mark));
    // Neighbours often set the same mark.
    const auto is_new =
        hn::And(hn::RebindMask(di, is_obstacle), hn::Ne(mark, move_up(mark, hn::Set(di, no_mark))));
    counts.marked += compress_store(mark, is_new, marked_.data() + counts.marked);
  }

  /// Sets the first `count` listed marks.
  HWY_INLINE void set_marks(std::size_t count) {
    const ObstacleCells& obstacles = scan_.obstacles;
    for (std::size_t i = 0; i < count; ++i) {
      // Other threads may set the same mark.
      std::atomic_ref<std::uint8_t>(obstacles.marks[marked_[i]])
          .store(obstacles.mark, std::memory_order_relaxed);
    }
  }

  static constexpr std::int32_t no_mark = -1;

  const MeasuredScan& scan_;
  const MeasuredSlice& slice_;
  Counts counts_;
  std::array<std::int32_t, lookup_size + lanes> marked_;  ///< marks to set
};

/// Returns the number of undecided points.
std::size_t measure_points(const MeasuredScan& scan, const MeasuredSlice& slice,
                           LabelTotals& totals) {
  Lookups lookups;
  LabelPoints results(scan, slice);
  for (std::size_t begin = slice.begin; begin < slice.end; begin += lookup_size) {
    const std::size_t end = std::min(begin + lookup_size, slice.end);
    lookups.squares = 0;
    FindSquares find(scan, begin, lookups);
    read_cloud(scan.cloud, begin, end, find);
    look_up(scan.tables, lookups);
    results.label(lookups, begin - slice.begin, end - begin);
  }
  const Counts& counts = results.counts();
  totals[static_cast<std::size_t>(Label::ground)] += counts.ground;
  totals[static_cast<std::size_t>(Label::noise)] += counts.noise;
  totals[static_cast<std::size_t>(Label::out_of_range)] += counts.out_of_range;
  totals[static_cast<std::size_t>(Label::invalid)] += counts.invalid;
  return counts.undecided;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(measure_points);

/// Number of 0.5 m cells along one side.
std::size_t obstacle_width(const SquareCells& cells) {
  return static_cast<std::size_t>(4 * cells.extent());
}

/// Distance of the chunks in the lists of undecided points.
constexpr std::size_t chunk_stride = plane_fits::chunk_size + 16;

}  // namespace

PointHeights::PointHeights(const SurfaceConfig& config, const SquareCells& cells)
    : cells_(&cells), rule_(config.point) {
  const std::size_t width = obstacle_width(cells);
  obstacle_bytes_ = 2 * width * width;
  obstacles_.reserve(obstacle_bytes_);
  std::fill_n(obstacles_.data(), obstacle_bytes_, std::uint8_t{0});
}

void PointHeights::reserve(std::size_t points) {
  const std::size_t chunks = plane_fits::chunk_count(points);
  undecided_points_.reserve(chunks * chunk_stride);
  undecided_cells_.reserve(chunks * chunk_stride);
  undecided_counts_.reserve(chunks);
}

void PointHeights::set_surface(std::span<const Grid> grids) noexcept {
  // A different mark in each scan, so that the cells need not be cleared.
  if (++mark_ == 0) {
    std::fill_n(obstacles_.data(), obstacle_bytes_, std::uint8_t{0});
    mark_ = 1;
  }
  tables_.count = grids.size();
  tables_.heights = grids.front().heights;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const Grid& grid = grids[i];
    const auto width = static_cast<std::int32_t>(grid.width);
    const bool inner = grid.extent() < grids.front().extent();
    tables_.extents[i] = inner ? grid.extent() - grid.cell / 2 : grid.extent();
    tables_.per_cell[i] = 1 / grid.cell;
    tables_.middles[i] = static_cast<float>(width - 1) / 2;
    tables_.last[i] = static_cast<float>(width - 1);
    tables_.strides[i] = 1 | width << 16;
    tables_.firsts[i] = static_cast<std::int32_t>(grid.heights - tables_.heights);
    if (!inner) {
      const float last_centre = grid.extent() - grid.cell / 2;
      tables_.reaches_edge = cells_->max_squared_range() > last_centre * last_centre;
    }
  }
}

void PointHeights::measure(CloudView cloud, const std::uint8_t* unusual, std::size_t chunk,
                           const Results& results, LabelTotals& totals) noexcept {
  // The two limits are a quarter below and a quarter above the height of an obstacle.
  const ObstacleCells obstacles{.marks = obstacles_.data(),
                                .mark = mark_,
                                .width = static_cast<std::int32_t>(obstacle_width(*cells_)),
                                .edge = 2 * cells_->extent(),
                                .low = 0.75f * rule_.obstacle_height,
                                .high = 1.25f * rule_.obstacle_height};
  const MeasuredScan scan{.cloud = cloud,
                          .unusual = unusual,
                          .tables = tables_,
                          .cells = *cells_,
                          .obstacles = obstacles,
                          .rule = rule_};
  const std::size_t begin = chunk * plane_fits::chunk_size;
  const MeasuredSlice slice{
      .begin = begin,
      .end = std::min(begin + plane_fits::chunk_size, cloud.size()),
      .heights = results.heights.data() + begin,
      .labels = reinterpret_cast<std::uint8_t*>(results.labels.data()) + begin,
      .undecided_points = undecided_points_.data() + chunk * chunk_stride,
      .undecided_cells = undecided_cells_.data() + chunk * chunk_stride};
  undecided_counts_.data()[chunk] =
      static_cast<std::uint32_t>(HWY_DYNAMIC_DISPATCH(measure_points)(scan, slice, totals));
}

void PointHeights::label(std::size_t chunk, const Results& results, LabelTotals& totals) noexcept {
  // By the two marks of the cell: low, high.
  const float middle = (rule_.margin + rule_.obstacle_margin) / 2;
  const std::array<float, 4> margins = {rule_.margin, middle, rule_.obstacle_margin,
                                        rule_.obstacle_margin};
  const std::size_t begin = chunk * plane_fits::chunk_size;
  const float* const heights = results.heights.data() + begin;
  Label* const labels = results.labels.data() + begin;
  const std::uint32_t* const points = undecided_points_.data() + chunk * chunk_stride;
  const std::uint32_t* const cells = undecided_cells_.data() + chunk * chunk_stride;
  std::size_t ground_count = 0;
  for (std::size_t i = 0; i < undecided_counts_.data()[chunk]; ++i) {
    const std::uint8_t* const marks = obstacles_.data() + 2 * std::size_t{cells[i]};
    const auto index = static_cast<std::size_t>(marks[0] == mark_) +
                       2 * static_cast<std::size_t>(marks[1] == mark_);
    const bool is_ground = heights[points[i]] < margins[index];
    labels[points[i]] = is_ground ? Label::ground : Label::nonground;
    ground_count += static_cast<std::size_t>(is_ground);
  }
  totals[static_cast<std::size_t>(Label::ground)] += ground_count;
}

}  // namespace flagstone::surface
#endif

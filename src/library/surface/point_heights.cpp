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

/// Marks of squares with obstacles. Each square has two bytes: the first is `mark` if it contains a
/// point above `low`, the second if it contains a point above `high`.
struct ObstacleMarks {
  std::uint8_t* marks;
  std::uint8_t mark;  ///< of this scan
  float low, high;    ///< metres above the surface
};

/// Bits of a Square::index without the grid.
inline constexpr std::int32_t index_mask = (1 << grid_shift) - 1;

/// Data for all points of a scan.
struct MeasuredScan {
  CloudView cloud;
  const std::uint8_t* unusual;  ///< see PackedPoints::unusual
  const GridTables& tables;
  const SquareCells& cells;
  const ObstacleMarks& obstacles;
  const PointRule& rule;
};

/// Where to write the results of consecutive points, and the points without a final label.
struct MeasuredSlice {
  std::size_t begin, end;     ///< points of the cloud
  float* heights;             ///< of point `begin`
  std::uint8_t* labels;       ///< of point `begin`
  UndecidedPoint* undecided;  ///< up to one per point
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

/// `reaches_edge`: whether the coordinate can lie beyond the first or last centre.
template <bool reaches_edge>
HWY_INLINE Between between(FloatVector coordinate, FloatVector per_cell, FloatVector middle,
                           FloatVector last) {
  const FloatTag d;
  FloatVector centre = hn::Add(hn::Mul(coordinate, per_cell), middle);
  FloatVector first = centre;
  if constexpr (reaches_edge) {
    centre = hn::Min(hn::Max(centre, hn::Zero(d)), last);
    first = hn::Min(centre, hn::Sub(last, hn::Set(d, 1.0f)));
  }
  const IntVector whole = whole_part(first);
  return {whole, hn::Sub(centre, hn::ConvertTo(d, whole))};
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
  IntVector index;  ///< index of the first height | grid << grid_shift
  FloatVector share_x, share_y;
};

/// Finds the squares around points within the extent.
template <bool reaches_edge>
class SquareFinder {
 public:
  HWY_INLINE explicit SquareFinder(const GridTables& tables)
      : count_(std::min(tables.count, tables.extents.size())),
        extents_(tables.extents),
        last_centres_(tables.last.data()),
        per_cell_(tables.per_cell.data()),
        middles_(tables.middles.data()),
        strides_(tables.strides.data()),
        firsts_(tables.firsts.data()) {}

  HWY_INLINE Square at(FloatVector x, FloatVector y) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector reach = hn::Max(hn::Abs(x), hn::Abs(y));
    IntVector grid = hn::Zero(di);
    for (std::size_t i = 1; i < count_; ++i) {
      const auto covers = hn::Le(reach, hn::Set(d, extents_[i]));
      grid = increment_if(hn::RebindMask(di, covers), grid);
    }
    const FloatVector per_cell = per_cell_[grid];
    const FloatVector middle = middles_[grid];
    FloatVector last = middle;  // not used inside
    if constexpr (reaches_edge) last = last_centres_[grid];
    const Between column = between<reaches_edge>(x, per_cell, middle, last);
    const Between row = between<reaches_edge>(y, per_cell, middle, last);
    const IntVector cell = hn::Or(column.first, hn::ShiftLeft<16>(row.first));
    return {hn::Add(firsts_[grid], sum_of_products(cell, strides_[grid])), column.share, row.share};
  }

 private:
  std::size_t count_;
  std::array<float, 8> extents_;
  Table8<FloatTag> last_centres_, per_cell_, middles_;
  Table8<IntTag> strides_, firsts_;
};

/// Intermediate results of up to `lookup_size` points.
struct alignas(64) Lookups {
  template <class T>
  using PerPoint = std::array<T, lookup_size>;

  PerPoint<float> share_x, share_y;
  PerPoint<float> z;             ///< NaN for points that are invalid or out of range
  PerPoint<std::int32_t> index;  ///< of the square; see Square::index
  PerPoint<std::int32_t> code;   ///< label of points without a height, and of noise below all cells
  std::array<std::uint8_t, lookup_size> has_code;  ///< per vector: whether any point has a code

  /// Per vector: where the square of the surface differs from that of the point before.
  std::array<std::uint16_t, lookup_size> starts;
  /// The indices of the squares, one per start.
  std::array<std::int32_t, lookup_size + lanes> indices;
  /// The heights of the squares.
  std::array<float, lookup_size + lanes> near_left, near_right, far_left, far_right;
};

/// The code of points that have none.
inline constexpr std::int32_t no_code = -1;

HWY_INLINE IntVector code_of(Label label) {
  return hn::Set(IntTag(), static_cast<std::int32_t>(label));
}

/// Finds the squares of the surface around points.
template <bool reaches_edge>
class FindSquares {
 public:
  /// For points from `begin` on.
  HWY_INLINE FindSquares(const MeasuredScan& scan, std::size_t begin, Lookups& lookups)
      : unusual_(scan.unusual + begin / 4),
        lookups_(lookups),
        locator_(scan.cells),
        squares_(scan.tables),
        previous_(hn::Set(IntTag(), -1)) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) {
    const FloatTag d;
    const IntTag di;
    const std::size_t vector = i / hn::Lanes(d);
    lookups_.has_code[vector] = unusual_[i / 4];
    if (HWY_UNLIKELY(unusual_[i / 4] != 0)) {
      const FloatVector squared_range = hn::Add(hn::Mul(x, x), hn::Mul(y, y));
      const auto good = locator_.is_good(squared_range, x, y, z);
      const auto too_low = hn::And(good, locator_.is_below_cells(squared_range, z));
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

    const Square square = squares_.at(x, y);
    hn::Store(square.index, di, lookups_.index.data() + i);
    hn::Store(square.share_x, d, lookups_.share_x.data() + i);
    hn::Store(square.share_y, d, lookups_.share_y.data() + i);
    const auto starts = hn::Ne(square.index, move_up(square.index, previous_));
    previous_ = square.index;
    found_ += compress_store(square.index, starts, lookups_.indices.data() + found_);
    lookups_.starts[vector] = static_cast<std::uint16_t>(bits_of(di, starts));
  }

  /// Number of squares.
  [[nodiscard]] std::size_t found() const { return found_; }

 private:
  const std::uint8_t* unusual_;
  Lookups& lookups_;
  CellLocator locator_;
  SquareFinder<reaches_edge> squares_;
  IntVector previous_;  ///< squares of the previous vector, -1 before the first
  std::size_t found_ = 0;
};

/// Reads the heights of the first `count` squares. Neighbours in the cloud often share a square, so
/// this takes less time than reading them for every point.
HWY_INLINE void look_up(const GridTables& tables, std::size_t count, Lookups& lookups) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(lookups.indices[i]);
    const float* const near = tables.heights + (index & index_mask);
    const float* const far = near + tables.widths[index >> grid_shift];
    lookups.near_left[i] = near[0];
    lookups.near_right[i] = near[1];
    lookups.far_left[i] = far[0];
    lookups.far_right[i] = far[1];
  }
}

/// The height of the surface at the points of a vector, bit-identical to GroundSurface::height.
/// Their squares are consecutive from `first`; `starts` has a bit for each point with a new square.
template <bool reaches_edge>
HWY_INLINE FloatVector surface_at(const Lookups& lookups, std::size_t i, std::size_t first,
                                  std::uint32_t starts) {
  const FloatTag d;
  const IntVector rank = ranks_of(starts | 1U);
  const FloatVector share_x = hn::Load(d, lookups.share_x.data() + i);
  const FloatVector share_y = hn::Load(d, lookups.share_y.data() + i);
  const FloatVector near_left = lookup_in_one(lookups.near_left.data() + first, rank);
  const FloatVector near_right = lookup_in_one(lookups.near_right.data() + first, rank);
  const FloatVector far_left = lookup_in_one(lookups.far_left.data() + first, rank);
  const FloatVector far_right = lookup_in_one(lookups.far_right.data() + first, rank);
  const FloatVector height =
      blend(blend(near_left, near_right, share_x), blend(far_left, far_right, share_x), share_y);
  if (!reaches_edge && HWY_LIKELY(hn::AllFalse(d, hn::IsNaN(height)))) return height;
  return blend_with_care(blend_with_care(near_left, near_right, share_x),
                         blend_with_care(far_left, far_right, share_x), share_y);
}

/// Limits of heights above the surface, metres.
struct Limits {
  HWY_INLINE Limits(const PointRule& rule, const ObstacleMarks& obstacles)
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

/// Lists of a block of up to `lookup_size` points.
struct BlockLists {
  std::array<std::int32_t, lookup_size + lanes> undecided;  ///< indices of points in the block
  std::array<std::int32_t, 2 * lookup_size> marked;         ///< marks to set
};

/// Computes heights and labels.
template <bool reaches_edge>
class LabelPoints {
 public:
  HWY_INLINE LabelPoints(const MeasuredScan& scan, const MeasuredSlice& slice)
      : scan_(scan), slice_(slice) {}

  /// Labels `count` points, beginning with point `begin` of the slice.
  HWY_INLINE void label(Lookups& lookups, std::size_t begin, std::size_t count) {
    const FloatTag d;
    const Limits limits(scan_.rule, scan_.obstacles);
    float* const heights = slice_.heights + begin;
    std::uint8_t* const labels = slice_.labels + begin;
    Counts counts;
    std::size_t squares = 0;  // that begin before the vector
    std::size_t i = 0;
    const auto next_heights = [&]() HWY_ATTR {
      const std::uint32_t starts = lookups.starts[i / hn::Lanes(d)];
      // If the first point starts no square, it uses the last one before.
      const FloatVector surface =
          surface_at<reaches_edge>(lookups, i, squares - 1 + (starts & 1U), starts);
      squares += static_cast<std::size_t>(std::popcount(starts));
      return hn::Sub(hn::Load(d, lookups.z.data() + i), surface);
    };
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
      const FloatVector height = next_heights();
      hn::StoreU(height, d, heights + i);
      label_vector(lookups, i, begin, height, limits, counts, labels + i);
    }
    if (i < count) {
      label_rest(lookups, i, begin, next_heights(), count - i, limits, counts);
    }
    set_marks(counts.marked);
    list_undecided(lookups, begin, counts.undecided);
    totals_.ground += counts.ground;
    totals_.noise += counts.noise;
    totals_.out_of_range += counts.out_of_range;
    totals_.invalid += counts.invalid;
  }

  [[nodiscard]] const Counts& totals() const { return totals_; }

 private:
  /// Labels the points of a vector. Points with an unknown height are `nonground`, unless they have
  /// a code.
  HWY_INLINE void label_vector(const Lookups& lookups, std::size_t i, std::size_t begin,
                               FloatVector height, const Limits& limits, Counts& counts,
                               std::uint8_t* labels) {
    const FloatTag d;
    const IntTag di;
    mark(lookups, i, height, limits, counts);

    static_assert(static_cast<int>(Label::nonground) == 0 && static_cast<int>(Label::ground) == 1);
    const auto below_least = hn::Lt(height, limits.least_margin);
    store_bits(bits_of(d, below_least), labels);
    counts.ground += hn::CountTrue(d, below_least);
    auto undecided =
        hn::And(hn::Ge(height, limits.least_margin), hn::Lt(height, limits.most_margin));
    const auto may_be_noise = hn::Le(height, limits.noise);
    const bool has_code = lookups.has_code[i / hn::Lanes(d)] != 0;
    if (HWY_UNLIKELY(has_code || !hn::AllFalse(d, may_be_noise))) {
      relabel(lookups, i, begin, height, limits, counts, labels);
      if (has_code) {
        const IntVector code = hn::Load(di, lookups.code.data() + i);
        undecided = hn::And(undecided, hn::RebindMask(d, hn::Eq(code, hn::Set(di, no_code))));
      }
    }
    const IntVector points = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(i)));
    counts.undecided += compress_store(points, hn::RebindMask(di, undecided),
                                       lists_.undecided.data() + counts.undecided);
  }

  /// Replaces the labels of noise and of points with a code.
  HWY_INLINE void relabel(const Lookups& lookups, std::size_t i, std::size_t begin,
                          FloatVector height, const Limits& limits, Counts& counts,
                          std::uint8_t* labels) {
    const FloatTag d;
    const IntTag di;
    const auto below_least = hn::Lt(height, limits.least_margin);
    IntVector label = hn::IfThenElseZero(hn::RebindMask(di, below_least), code_of(Label::ground));
    const FloatVector deepest = hn::Sub(
        limits.noise, hn::Mul(hn::Set(d, scan_.rule.noise_depth_per_metre), ranges(begin + i)));
    const auto noise = hn::Le(height, deepest);
    label = hn::IfThenElse(hn::RebindMask(di, noise), code_of(Label::noise), label);
    counts.ground -= hn::CountTrue(d, hn::And(noise, below_least));
    counts.noise += hn::CountTrue(d, noise);
    if (lookups.has_code[i / hn::Lanes(d)] != 0) {
      const IntVector code = hn::Load(di, lookups.code.data() + i);
      const auto has_code = hn::Ne(code, hn::Set(di, no_code));
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
    const hn::Rebind<std::uint8_t, FloatTag> d8;
    hn::StoreU(hn::DemoteTo(d8, label), d8, labels);
  }

  /// Distances of points from the sensor, from point `first` of the slice on.
  HWY_INLINE FloatVector ranges(std::size_t first) const {
    const FloatTag d;
    HWY_ALIGN std::array<float, lanes> squares{};
    const std::size_t begin = slice_.begin + first;
    for (std::size_t i = 0; i < hn::Lanes(d) && begin + i < slice_.end; ++i) {
      const Point p = scan_.cloud[begin + i];
      squares[i] = p.x * p.x + p.y * p.y;
    }
    return hn::Sqrt(hn::Load(d, squares.data()));
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
    hn::Store(height, d, heights.data());
    label_vector(lookups, i, begin, height, limits, counts, labels.data());
    std::copy_n(heights.data(), rest, slice_.heights + begin + i);
    std::copy_n(labels.data(), rest, slice_.labels + begin + i);
  }

  /// Lists the marks of points on obstacles.
  HWY_INLINE void mark(const Lookups& lookups, std::size_t i, FloatVector height,
                       const Limits& limits, Counts& counts) {
    const FloatTag d;
    const IntTag di;
    const auto is_obstacle =
        hn::And(hn::Gt(height, limits.low), hn::Lt(height, limits.overhanging));
    if (hn::AllFalse(d, is_obstacle)) return;
    const IntVector square =
        hn::And(hn::Load(di, lookups.index.data() + i), hn::Set(di, index_mask));
    const auto is_high = hn::RebindMask(di, hn::Gt(height, limits.high));
    const IntVector mark =
        hn::IfThenElse(hn::RebindMask(di, is_obstacle),
                       increment_if(is_high, hn::ShiftLeft<1>(square)), hn::Set(di, no_mark));
    // Neighbours often set the same mark.
    const auto is_new =
        hn::And(hn::RebindMask(di, is_obstacle), hn::Ne(mark, move_up(mark, hn::Set(di, no_mark))));
    counts.marked += compress_store(mark, is_new, lists_.marked.data() + counts.marked);
  }

  /// Sets the first `count` listed marks.
  HWY_INLINE void set_marks(std::size_t count) {
    const ObstacleMarks& obstacles = scan_.obstacles;
    for (std::size_t i = 0; i < count; ++i) {
      // Other threads may set the same mark.
      std::atomic_ref<std::uint8_t>(obstacles.marks[lists_.marked[i]])
          .store(obstacles.mark, std::memory_order_relaxed);
    }
  }

  /// Adds the first `count` undecided points of the block to those of the slice.
  HWY_INLINE void list_undecided(const Lookups& lookups, std::size_t begin, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto point = static_cast<std::size_t>(lists_.undecided[i]);
      slice_.undecided[totals_.undecided++] = {
          .point = static_cast<std::uint32_t>(begin + point),
          .square = static_cast<std::uint32_t>(lookups.index[point]) & index_mask};
    }
  }

  static constexpr std::int32_t no_mark = -1;

  const MeasuredScan& scan_;
  const MeasuredSlice& slice_;
  Counts totals_;
  BlockLists lists_;
};

/// Returns the number of undecided points.
template <bool reaches_edge>
HWY_INLINE std::size_t measure_all(const MeasuredScan& scan, const MeasuredSlice& slice,
                                   LabelTotals& totals) {
  Lookups lookups;
  LabelPoints<reaches_edge> results(scan, slice);
  for (std::size_t begin = slice.begin; begin < slice.end; begin += lookup_size) {
    const std::size_t end = std::min(begin + lookup_size, slice.end);
    FindSquares<reaches_edge> find(scan, begin, lookups);
    read_cloud(scan.cloud, begin, end, find);
    look_up(scan.tables, find.found(), lookups);
    results.label(lookups, begin - slice.begin, end - begin);
  }
  const Counts& counts = results.totals();
  totals[static_cast<std::size_t>(Label::ground)] += counts.ground;
  totals[static_cast<std::size_t>(Label::noise)] += counts.noise;
  totals[static_cast<std::size_t>(Label::out_of_range)] += counts.out_of_range;
  totals[static_cast<std::size_t>(Label::invalid)] += counts.invalid;
  return counts.undecided;
}

std::size_t measure_points(const MeasuredScan& scan, const MeasuredSlice& slice,
                           LabelTotals& totals) {
  return scan.tables.reaches_edge ? measure_all<true>(scan, slice, totals)
                                  : measure_all<false>(scan, slice, totals);
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(measure_points);

}  // namespace

PointHeights::PointHeights(const SurfaceConfig& config, const SquareCells& cells,
                           std::span<const Grid> grids)
    : cells_(&cells), rule_(config.point) {
  for (const Grid& grid : grids) mark_count_ += 2 * grid.size();
  marks_.reserve(mark_count_);
  std::fill_n(marks_.data(), mark_count_, std::uint8_t{0});
}

void PointHeights::reserve(std::size_t points) {
  const std::size_t chunks = plane_fits::chunk_count(points);
  undecided_.reserve(points);
  undecided_counts_.reserve(chunks);
}

void PointHeights::set_surface(std::span<const Grid> grids) noexcept {
  // A different mark in each scan, so that the marks need not be cleared.
  if (++mark_ == 0) {
    std::fill_n(marks_.data(), mark_count_, std::uint8_t{0});
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
    tables_.widths[i] = width;
    tables_.strides[i] = 1 | width << 16;
    const auto first = static_cast<std::int32_t>(grid.heights - tables_.heights);
    tables_.firsts[i] = first | static_cast<std::int32_t>(i) << grid_shift;
    if (!inner) {
      const float last_centre = grid.extent() - grid.cell / 2;
      tables_.reaches_edge = cells_->max_squared_range() > last_centre * last_centre;
    }
  }
}

void PointHeights::measure(CloudView cloud, const std::uint8_t* unusual, std::size_t chunk,
                           const Results& results, LabelTotals& totals) noexcept {
  // The two limits are a quarter below and a quarter above the height of an obstacle.
  const ObstacleMarks obstacles{.marks = marks_.data(),
                                .mark = mark_,
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
      .undecided = undecided_.data() + begin};
  undecided_counts_.data()[chunk] =
      static_cast<std::uint32_t>(HWY_DYNAMIC_DISPATCH(measure_points)(scan, slice, totals));
}

void PointHeights::label(std::size_t chunk, const Results& results, LabelTotals& totals) noexcept {
  // By the two marks of the square: low, high.
  const float middle = (rule_.margin + rule_.obstacle_margin) / 2;
  const std::array<float, 4> margins = {rule_.margin, middle, rule_.obstacle_margin,
                                        rule_.obstacle_margin};
  const std::size_t begin = chunk * plane_fits::chunk_size;
  const float* const heights = results.heights.data() + begin;
  Label* const labels = results.labels.data() + begin;
  const std::span undecided(undecided_.data() + begin, undecided_counts_.data()[chunk]);
  std::size_t ground_count = 0;
  for (const UndecidedPoint& one : undecided) {
    const std::uint8_t* const marks = marks_.data() + 2 * std::size_t{one.square};
    const auto index = static_cast<std::size_t>(marks[0] == mark_) +
                       2 * static_cast<std::size_t>(marks[1] == mark_);
    const bool is_ground = heights[one.point] < margins[index];
    labels[one.point] = is_ground ? Label::ground : Label::nonground;
    ground_count += static_cast<std::size_t>(is_ground);
  }
  totals[static_cast<std::size_t>(Label::ground)] += ground_count;
}

}  // namespace flagstone::surface
#endif

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/packed_points.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "library/surface/distinct_points.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/packed_points.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/plane_fits/read_slice-inl.hpp"
#include "library/surface/square_cells-inl.hpp"

#ifndef FLAGSTONE_SURFACE_PACKED_POINTS_ONCE
#define FLAGSTONE_SURFACE_PACKED_POINTS_ONCE
namespace flagstone::surface {

/// Points of a cloud to pack, and the destination.
struct PackedSlice {
  CloudView cloud;
  std::size_t begin, end;
  PackedPoint* points;  ///< 16 more elements can be written
  std::uint8_t* unusual;
  plane_fits::RunStart* starts;  ///< 17 more elements can be written
};

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

class PackVector {
 public:
  HWY_INLINE PackVector(const PackedSlice& slice, const SquareCells& cells)
      : points_(reinterpret_cast<std::int32_t*>(slice.points)),
        unusual_(slice.unusual),
        locator_(cells),
        runs_(slice.starts) {}

  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) {
    const Located located = locator_.locate(x, y, z);
    hn::StoreU(located.packed, IntTag(), points_ + i);
    // A vector can have fewer than four points.
    const unsigned before = i % 4 == 0 ? 0U : unusual_[i / 4];
    unusual_[i / 4] = static_cast<std::uint8_t>(before | (located.all_have_cells ? 0U : 1U));
    runs_.add(located.cell);
  }

  /// Returns the number of runs of `count` points.
  std::size_t close(std::size_t count) { return runs_.close(count); }

 private:
  std::int32_t* points_;
  std::uint8_t* unusual_;
  CellLocator locator_;
  plane_fits::HWY_NAMESPACE::RunWriter runs_;
};

std::size_t pack_slice(const PackedSlice& slice, const SquareCells& cells) {
  PackVector pack(slice, cells);
  read_cloud(slice.cloud, slice.begin, slice.end, pack);
  return pack.close(slice.end - slice.begin);
}

/// Copies `count` points, 1 to 16, without branches. Leaves the points after them unchanged, but
/// can read sixteen and write them back.
HWY_INLINE void copy_up_to_16(const PackedPoint* from, std::size_t count, PackedPoint* to) {
  const hn::CappedTag<std::uint32_t, 16> d;
#if HWY_TARGET <= HWY_AVX3
  hn::BlendedStore(hn::LoadU(d, from), hn::FirstN(d, count), d, to);
#else
  // Masked stores are slow here.
  const auto end = hn::Set(d, static_cast<std::uint32_t>(count));
  for (std::size_t i = 0; i < 16; i += hn::Lanes(d)) {
    const auto copied = hn::Lt(hn::Iota(d, static_cast<std::uint32_t>(i)), end);
    hn::StoreU(hn::IfThenElse(copied, hn::LoadU(d, from + i), hn::LoadU(d, to + i)), d, to + i);
  }
#endif
}

/// Copies a run of `count` points.
struct CopyRun {
  HWY_INLINE void operator()(const PackedPoint* from, std::size_t count, PackedPoint* to) const {
    if (HWY_LIKELY(count <= 16)) {
      copy_up_to_16(from, count, to);
    } else {
      std::memcpy(to, from, count * sizeof(PackedPoint));
    }
  }
};

/// As CopyRun, faster for single points.
struct CopyShortRun {
  HWY_INLINE void operator()(const PackedPoint* from, std::size_t count, PackedPoint* to) const {
    to[0] = from[0];
    if (HWY_UNLIKELY(count > 1)) CopyRun()(from + 1, count - 1, to + 1);
  }
};

/// Copies each run to the next position of its cell, `next[cell]`, and advances it. Nearly all runs
/// take one step of up to sixteen points, which avoids mispredicted branches. Points without an
/// order have runs of one point.
void sort_runs(const plane_fits::ScanRuns::Chunk& runs, std::uint32_t* HWY_RESTRICT next,
               const PackedPoint* HWY_RESTRICT points, PackedPoint* HWY_RESTRICT sorted) {
  const auto [starts, run_count, first] = runs;  // copies, which stores cannot change
  const auto copy_all = [&](const auto& copy) HWY_ATTR {
    for (std::size_t run = 0; run < run_count; ++run) {
      const std::uint32_t begin = starts[run] >> plane_fits::bin_bits;
      const std::uint32_t end = starts[run + 1] >> plane_fits::bin_bits;
      const std::uint32_t cell = starts[run] & plane_fits::bin_mask;
      PackedPoint* const to = sorted + next[cell];
      next[cell] += end - begin;
      copy(points + first + begin, end - begin, to);
    }
  };
  const std::size_t point_count = starts[run_count] >> plane_fits::bin_bits;
  if (5 * run_count > 4 * point_count) {
    copy_all(CopyShortRun());
  } else {
    copy_all(CopyRun());
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(pack_slice);
HWY_EXPORT(sort_runs);

/// Number of points that are compared to find out whether points are repeated.
constexpr std::size_t points_to_compare = 512;

/// Elements that vectors can read or write after the last one.
constexpr std::size_t slack = 16;

}  // namespace

void PackedPoints::reserve(std::size_t points, const SquareCells& cells) {
  packed_.reserve(points + 2 * slack);
  sorted_.reserve(points + 2 * slack);
  unusual_.reserve(points / 4 + slack);
  runs_.reserve(points);
  begins_.reserve(cells.group_count() + 1);
}

void PackedPoints::read(CloudView cloud, std::size_t chunk, const SquareCells& cells) noexcept {
  const std::size_t begin = chunk * plane_fits::chunk_size;
  const PackedSlice slice{.cloud = cloud,
                          .begin = begin,
                          .end = std::min(begin + plane_fits::chunk_size, cloud.size()),
                          .points = packed_.data() + begin,
                          .unusual = unusual_.data() + begin / 4,
                          .starts = runs_.starts(chunk)};
  runs_.set_count(chunk, HWY_DYNAMIC_DISPATCH(pack_slice)(slice, cells));
}

void PackedPoints::sort(std::size_t point_count, const SquareCells& cells) noexcept {
  const std::size_t chunks = plane_fits::chunk_count(point_count);
  const std::uint32_t groups = cells.group_count();
  // While points are sorted, next[cell] is the place of the next point of a cell. Afterwards it is
  // the first place of the next cell.
  begins_.data()[0] = 0;
  std::uint32_t* const next = begins_.data() + 1;
  std::fill_n(next, groups, 0U);
  runs_.for_each(chunks, [=](std::uint32_t cell, std::uint32_t, std::uint32_t length) {
    next[cell] += length;
  });
  std::uint32_t sum = 0;
  for (std::uint32_t cell = 0; cell < groups; ++cell) sum += std::exchange(next[cell], sum);
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    HWY_DYNAMIC_DISPATCH(sort_runs)(runs_.chunk(chunk), next, packed_.data(), sorted_.data());
  }
  cell_count_ = cells.cell_count();
  if (repeat(point_count)) remove_repeated();
}

/// Whether more than a third of the points repeat others. Compares about 512 points, in cells that
/// do not depend on the order of the points.
bool PackedPoints::repeat(std::size_t point_count) noexcept {
  const auto step = static_cast<std::uint32_t>(1 + point_count / points_to_compare);
  std::size_t seen = 0;
  std::size_t different = 0;
  for (std::uint32_t cell = 0; cell < cell_count_; cell += step) {
    const std::span<PackedPoint> held = mutable_points(cell);
    if (held.empty()) continue;
    seen += held.size();
    different += copy_distinct(held, packed_.data(), packed_.data());
  }
  return 3 * different < 2 * seen;
}

void PackedPoints::remove_repeated() noexcept {
  PackedPoint* kept = packed_.data();
  for (std::uint32_t cell = 0; cell < cell_count_; ++cell) {
    const std::span<PackedPoint> held = mutable_points(cell);
    PackedPoint* const scratch = packed_.data() + begins()[cell];
    begins_.data()[cell] = static_cast<std::uint32_t>(kept - packed_.data());
    if (!held.empty()) kept += copy_distinct(held, scratch, kept);
  }
  begins_.data()[cell_count_] = static_cast<std::uint32_t>(kept - packed_.data());
  std::swap(packed_, sorted_);
}

std::span<PackedPoint> PackedPoints::mutable_points(std::uint32_t cell) noexcept {
  return {sorted_.data() + begins()[cell], sorted_.data() + begins()[cell + 1]};
}

}  // namespace flagstone::surface
#endif

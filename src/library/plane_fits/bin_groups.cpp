// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/bin_groups.hpp"

#include <algorithm>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/bin_groups.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Writes the points of the runs one after another. May overwrite 16 more elements.
///
/// Copies eight points per step; the next run overwrites the excess. Most runs within a small cell
/// take one step, which avoids mispredicted branches.
void move_runs(const ScanPoints& scan, std::span<const Run> runs, MovedPoint* points) {
  constexpr std::size_t step = 8;
  const hn::CappedTag<float, step> d;
  const hn::RebindToSigned<decltype(d)> di;
  const float* HWY_RESTRICT from_x = scan.x();
  const float* HWY_RESTRICT from_y = scan.y();
  const float* HWY_RESTRICT from_z = scan.z();
  const auto places = hn::Iota(di, 0);
  auto* HWY_RESTRICT to = reinterpret_cast<float*>(points);
  for (const Run& run : runs) {
    std::size_t i = 0;
    do {
      for (std::size_t lane = 0; lane < step; lane += hn::Lanes(d)) {
        const std::size_t from = run.begin + i + lane;
        const auto index = hn::Add(hn::Set(di, static_cast<std::int32_t>(from)), places);
        hn::StoreInterleaved4(hn::LoadU(d, from_x + from), hn::LoadU(d, from_y + from),
                              hn::LoadU(d, from_z + from), hn::BitCast(d, index), d,
                              to + 4 * (i + lane));
      }
      i += step;
    } while (i < run.length);
    to += 4 * std::size_t{run.length};
  }
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::plane_fits {
namespace {
HWY_EXPORT(move_runs);

/// Minimum mean number of points per run for which sorting runs is faster than sorting points.
constexpr std::uint64_t shortest_mean_run(Listing listing) {
  return listing == Listing::runs ? 4 : 2;
}

/// Prefetch distance in points: two cache lines.
constexpr std::size_t prefetch_distance = 8;

/// Calls `work(bin, first point, number of points)` for every run, in input order.
template <class Work>
void for_each_run(const ScanPoints& scan, std::size_t chunks, const Work& work) {
  constexpr RunStart bin_mask = (1U << bin_bits) - 1;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const auto [starts, count] = scan.runs(chunk);
    const auto first = static_cast<std::uint32_t>(chunk * chunk_size);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t begin = starts[i] >> bin_bits;
      work(starts[i] & bin_mask, first + begin, (starts[i + 1] >> bin_bits) - begin);
    }
  }
}

}  // namespace

void BinGroups::reserve(std::size_t points, std::size_t bins) {
  const std::size_t blocks = bins / block_size + 1;
  if (blocks > blocks_) {
    blocks_ = 0;
    tallies_.reserve(blocks * block_size);
    block_firsts_.reserve(blocks + 1);
    block_marks_.reserve(blocks);
    blocks_ = blocks;
    std::fill_n(tallies_.data(), blocks * block_size, Tally{});
    std::fill_n(block_firsts_.data(), blocks + 1, Tally{});
    std::fill_n(block_marks_.data(), blocks, std::uint8_t{0});
  }
  runs_.reserve(points / static_cast<std::size_t>(shortest_mean_run(listing_)) + 1);
  points_.reserve(points + 16);
}

void BinGroups::group(const ScanPoints& scan, std::size_t point_count,
                      std::uint32_t groups) noexcept {
  const std::size_t chunks = ScanPoints::chunk_count(point_count);
  tally(scan, chunks);
  const Tally all = sum_up(groups);
  const bool short_runs = all.runs() * shortest_mean_run(listing_) > all.points();
  moved_ = short_runs || listing_ == Listing::points;
  if (short_runs) {
    sort(scan, chunks, [&](Tally place, std::uint32_t begin, std::uint32_t length) {
      MovedPoint* to = points_.data() + place.points();
      for (std::uint32_t i = begin; i < begin + length; ++i) {
        // Each bin is a separate stream, more streams than the hardware prefetcher can follow.
        __builtin_prefetch(to + prefetch_distance, 1);
        *to++ = {scan.x()[i], scan.y()[i], scan.z()[i], i};
      }
    });
  } else {
    sort(scan, chunks, [&](Tally place, std::uint32_t begin, std::uint32_t length) {
      runs_.data()[place.runs()] = {begin, length};
    });
    if (!moved_) return;
    const std::span<const Run> runs(runs_.data(), all.runs());
    HWY_DYNAMIC_DISPATCH(move_runs)(scan, runs, points_.data());
  }
}

void BinGroups::list_begins(std::uint32_t begin, std::uint32_t end,
                            std::uint32_t* begins) const noexcept {
  *begins++ = first(begin).points();
  for (std::uint32_t bin = begin; bin < end;) {
    const std::uint32_t block = bin / block_size;
    const std::uint32_t block_end = std::min((block + 1) * block_size, end);
    if (is_empty(block)) {
      std::fill_n(begins, block_end - bin, block_firsts_.data()[block].points());
      begins += block_end - bin;
      bin = block_end;
    } else {
      for (; bin < block_end; ++bin) *begins++ = tallies_.data()[bin].points();
    }
  }
}

/// Counts the points and runs of each bin, and marks the blocks that contain any.
void BinGroups::tally(const ScanPoints& scan, std::size_t chunks) noexcept {
  Tally* tallies = tallies_.data();
  for (std::size_t block = 0; block < used_blocks_; ++block) {  // counts of the previous scan
    if (is_empty(block)) continue;
    std::fill_n(tallies + block * block_size, block_size, Tally{});
  }
  std::uint8_t* marks = block_marks_.data();
  for_each_run(scan, chunks, [=](std::uint32_t bin, std::uint32_t, std::uint32_t length) {
    tallies[bin].add(Tally::run_of(length));
    marks[bin / block_size] = 1;
  });
}

/// Replaces the tally of each bin by the sum over the bins before it. Returns the sum over all
/// bins.
BinGroups::Tally BinGroups::sum_up(std::uint32_t groups) noexcept {
  used_blocks_ = groups / block_size + 1;
  Tally sum;
  Tally* tallies = tallies_.data();
  for (std::size_t block = 0; block < used_blocks_; ++block) {
    block_firsts_.data()[block] = sum;
    if (std::exchange(block_marks_.data()[block], std::uint8_t{0}) == 0) continue;
    for (std::size_t bin = block * block_size; bin < (block + 1) * block_size; ++bin) {
      const Tally held = std::exchange(tallies[bin], sum);
      sum.add(held);
    }
  }
  block_firsts_.data()[used_blocks_] = sum;
  return sum;
}

/// Calls `place` for each run with its position. Each bin starts with the tally before it and ends
/// with the tally up to and including it.
template <class Place>
void BinGroups::sort(const ScanPoints& scan, std::size_t chunks, const Place& place) noexcept {
  Tally* next = tallies_.data();
  for_each_run(scan, chunks, [&](std::uint32_t bin, std::uint32_t begin, std::uint32_t length) {
    const Tally before = next[bin];
    next[bin].add(Tally::run_of(length));
    place(before, begin, length);
  });
}

}  // namespace flagstone::plane_fits
#endif

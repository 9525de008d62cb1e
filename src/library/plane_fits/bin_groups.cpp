// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/bin_groups.hpp"

namespace flagstone::plane_fits {
namespace {

/// Minimum mean number of points per run for which sorting runs is faster than sorting points.
constexpr std::uint64_t shortest_mean_run = 4;

/// Prefetch distance in points: two cache lines.
constexpr std::size_t prefetch_distance = 8;

}  // namespace

void BinGroups::reserve(std::size_t points, std::size_t bins) {
  tallies_.reserve(bins);
  runs_.reserve(points / static_cast<std::size_t>(shortest_mean_run) + 1);
  points_.reserve(points + 16);
}

void BinGroups::group(const ScanPoints& scan, std::size_t point_count,
                      std::uint32_t groups) noexcept {
  const std::size_t chunks = chunk_count(point_count);
  const Tally all = tallies_.count(scan.runs(), chunks, groups);
  moved_ = all.runs() * shortest_mean_run > all.points();
  if (moved_) {
    tallies_.sort(scan.runs(), chunks, [&](Tally place, std::uint32_t begin, std::uint32_t length) {
      MovedPoint* to = points_.data() + place.points();
      for (std::uint32_t i = begin; i < begin + length; ++i) {
        // Each bin is a separate stream, more streams than the hardware prefetcher can follow.
        __builtin_prefetch(to + prefetch_distance, 1);
        *to++ = {scan.x()[i], scan.y()[i], scan.z()[i], i};
      }
    });
  } else {
    tallies_.sort(scan.runs(), chunks, [&](Tally place, std::uint32_t begin, std::uint32_t length) {
      runs_.data()[place.runs()] = {begin, length};
    });
  }
}

}  // namespace flagstone::plane_fits

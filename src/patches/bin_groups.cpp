// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patches/bin_groups.hpp"

#include <algorithm>

namespace flagstone::patches {
namespace {

/// Runs of fewer points than this on average are not worth keeping.
constexpr std::size_t shortest_mean_run = 4;

/// How far ahead of the next moved point memory is asked for: two cache lines.
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
  tallies_.reserve(bins);
  firsts_.reserve(bins + 1);
  next_.reserve(bins);
  runs_.reserve(points / shortest_mean_run + 1);
  points_.reserve(points + 16);
}

void BinGroups::group(const ScanPoints& scan, std::size_t point_count,
                      std::uint32_t groups) noexcept {
  const std::size_t chunks = ScanPoints::chunk_count(point_count);
  tally(scan, chunks, groups);
  if (scattered_) {
    sort(scan, chunks, [&](std::uint32_t& next, std::uint32_t begin, std::uint32_t length) {
      for (std::uint32_t i = begin; i < begin + length; ++i) {
        // Every bin is a stream of its own, more than the processor follows by itself.
        __builtin_prefetch(points_.data() + next + prefetch_distance, 1);
        points_.data()[next++] = {scan.x()[i], scan.y()[i], scan.z()[i], i};
      }
    });
  } else {
    sort(scan, chunks, [&](std::uint32_t& next, std::uint32_t begin, std::uint32_t length) {
      runs_.data()[next++] = {begin, length};
    });
  }
}

void BinGroups::tally(const ScanPoints& scan, std::size_t chunks, std::uint32_t groups) noexcept {
  std::uint64_t* tallies = tallies_.data();
  std::fill_n(tallies, groups, 0);
  for_each_run(scan, chunks, [=](std::uint32_t bin, std::uint32_t, std::uint32_t length) {
    tallies[bin] += (static_cast<std::uint64_t>(length) << 32U) | 1U;
  });

  std::uint64_t points = 0;
  std::uint64_t runs = 0;
  for (std::uint32_t bin = 0; bin < groups; ++bin) {
    points += tallies[bin] >> 32U;
    runs += static_cast<std::uint32_t>(tallies[bin]);
  }
  scattered_ = runs * shortest_mean_run > points;

  std::uint32_t first = 0;
  for (std::uint32_t bin = 0; bin < groups; ++bin) {
    firsts_.data()[bin] = next_.data()[bin] = first;
    first += scattered_ ? static_cast<std::uint32_t>(tallies[bin] >> 32U)
                        : static_cast<std::uint32_t>(tallies[bin]);
  }
  firsts_.data()[groups] = first;
}

template <class Place>
void BinGroups::sort(const ScanPoints& scan, std::size_t chunks, const Place& place) noexcept {
  std::uint32_t* next = next_.data();
  for_each_run(scan, chunks, [&](std::uint32_t bin, std::uint32_t begin, std::uint32_t length) {
    place(next[bin], begin, length);
  });
}

}  // namespace flagstone::patches

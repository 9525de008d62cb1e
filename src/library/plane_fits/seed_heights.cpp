// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/seed_heights.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/seed_heights.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_PLANE_FITS_SEED_HEIGHTS_ONCE
#define FLAGSTONE_PLANE_FITS_SEED_HEIGHTS_ONCE
namespace flagstone::plane_fits {

/// Maximum number of candidates per bin for sorting sixteen bins in parallel.
inline constexpr std::size_t most_candidates = 32;

/// Row r contains candidate r of each bin, metres; infinity if there is none.
struct alignas(64) Candidates : std::array<std::array<float, batch_size>, most_candidates> {};

/// Batcher's odd-even merge sort: pairs of rows to compare, and to exchange if the first is larger.
struct Comparison {
  std::uint8_t low, high;
};
inline constexpr auto sorting_network = [] {
  std::array<Comparison, 191> network{};
  std::size_t next = 0;
  constexpr std::size_t n = most_candidates;
  for (std::size_t p = 1; p < n; p *= 2) {
    for (std::size_t k = p; k >= 1; k /= 2) {
      for (std::size_t j = k % p; j + k < n; j += 2 * k) {
        for (std::size_t i = j; i < std::min(j + k, n - k); ++i) {
          if (i / (2 * p) != (i + k) / (2 * p)) continue;
          network.at(next++) = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i + k)};
        }
      }
    }
  }
  return network;
}();
static_assert(sorting_network.back().high != 0);  // all elements are set

}  // namespace flagstone::plane_fits
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// Sorts each column.
void sort_columns(Candidates& rows) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < batch_size; lane += hn::Lanes(d)) {
    float* columns = rows.front().data() + lane;
    const auto compare_exchange = [&](std::size_t low, std::size_t high) HWY_ATTR {
      const FloatVector a = hn::Load(d, columns + low * batch_size);
      const FloatVector b = hn::Load(d, columns + high * batch_size);
      hn::Store(hn::Min(a, b), d, columns + low * batch_size);
      hn::Store(hn::Max(a, b), d, columns + high * batch_size);
    };
    for (const auto& [low, high] : sorting_network) compare_exchange(low, high);
  }
}

/// Finds, in each of the 16 lanes, the two lowest heights that are not below `floor`.
void lowest_of_lanes(const float* HWY_RESTRICT z, std::size_t places, float floor,
                     float* HWY_RESTRICT lowest) {
  const FloatTag d;
  const FloatVector none = hn::Set(d, std::numeric_limits<float>::infinity());
  const FloatVector bottom = hn::Set(d, floor);
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    FloatVector first = none;
    FloatVector second = none;
    for (std::size_t i = lane; i < places; i += lanes) {
      const FloatVector height = hn::Load(d, z + i);
      const FloatVector candidate = hn::IfThenElse(hn::Ge(height, bottom), height, none);
      second = hn::Min(second, hn::Max(first, candidate));
      first = hn::Min(first, candidate);
    }
    hn::StoreU(first, d, lowest + lane);
    hn::StoreU(second, d, lowest + lanes + lane);
  }
}

/// Copies the heights from `floor` to `ceiling` and returns their number. May write 16 more
/// elements.
std::size_t copy_between(const float* HWY_RESTRICT z, std::size_t places, float floor,
                         float ceiling, float* HWY_RESTRICT heights) {
  const FloatTag d;
  const FloatVector bottom = hn::Set(d, floor);
  const FloatVector top = hn::Set(d, ceiling);
  std::size_t count = 0;
  for (std::size_t i = 0; i < places; i += hn::Lanes(d)) {
    const FloatVector height = hn::Load(d, z + i);
    const auto inside = hn::And(hn::Ge(height, bottom), hn::Le(height, top));
    count += compress_store(height, inside, heights + count);
  }
  return count;
}

/// Computes the mean of the finite heights in the first `seed_counts[i]` rows of each column.
/// `most` is the largest of these counts.
void mean_of_rows(const Candidates& rows, const Batch& seed_counts, std::size_t most,
                  Batch& means) {
  const DoubleTag d;
  const hn::Rebind<float, DoubleTag> df;
  for (std::size_t lane = 0; lane < batch_size; lane += hn::Lanes(d)) {
    DoubleVector sum = hn::Zero(d);
    DoubleVector count = hn::Zero(d);
    const DoubleVector wanted = hn::Load(d, seed_counts.data() + lane);
    for (std::size_t row = 0; row < most; ++row) {
      const DoubleVector height = hn::PromoteTo(d, hn::Load(df, rows[row].data() + lane));
      const auto there = hn::And(hn::Lt(height, hn::Set(d, 1e30)),
                                 hn::Lt(hn::Set(d, static_cast<double>(row)), wanted));
      sum = hn::Add(sum, hn::IfThenElseZero(there, height));
      count = hn::Add(count, hn::IfThenElseZero(there, hn::Set(d, 1.0)));
    }
    hn::Store(hn::Div(sum, hn::Max(count, hn::Set(d, 1.0))), d, means.data() + lane);
  }
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::plane_fits {
namespace {
HWY_EXPORT(sort_columns);
HWY_EXPORT(lowest_of_lanes);
HWY_EXPORT(copy_between);
HWY_EXPORT(mean_of_rows);

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float highest = std::numeric_limits<float>::max();

void set_column(Candidates& rows, std::size_t column, const float* heights, std::size_t count) {
  for (std::size_t row = 0; row < most_candidates; ++row) {
    rows[row][column] = row < count ? heights[row] : infinity;
  }
}

double mean_of_lowest(float* heights, std::size_t count, std::size_t seed_count) {
  const std::size_t seeds = std::min(count, seed_count);
  std::nth_element(heights, heights + (seeds - 1), heights + count);
  std::sort(heights, heights + seeds);
  double sum = 0;
  for (const float* z = heights; z < heights + seeds; ++z) sum += *z;
  return sum / static_cast<double>(seeds);
}

}  // namespace

/// The two lowest points of each lane are candidates. The N_seed-th lowest candidate is an upper
/// bound for the N_seed-th lowest point, and few points are below it. These points are sorted,
/// sixteen bins in parallel. If there are many, or N_seed is large, bins are sorted one by one.
void SeedHeights::find(const BinBatch& batch, const std::array<float, batch_size>& floors,
                       const std::array<std::uint32_t, batch_size>& counts, Batch& means,
                       double height_without_seeds) noexcept {
  means = {};
  float* heights = heights_.data();
  Candidates rows{};
  Batch few{};  // N_seed of the bins where it is not large
  std::size_t most = 0;
  for (std::size_t i = 0; i < batch.count(); ++i) {
    if (counts[i] > most_candidates) continue;
    few[i] = counts[i];
    most = std::max<std::size_t>(most, counts[i]);
    HWY_DYNAMIC_DISPATCH(lowest_of_lanes)(batch.z(i), batch.places(i), floors[i], heights);
    set_column(rows, i, heights, most_candidates);
  }

  if (most > 0) {
    HWY_DYNAMIC_DISPATCH(sort_columns)(rows);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      if (counts[i] > most_candidates) continue;
      const float bound = std::min(rows[counts[i] - 1][i], highest);
      const std::size_t count = HWY_DYNAMIC_DISPATCH(copy_between)(batch.z(i), batch.places(i),
                                                                   floors[i], bound, heights);
      if (count > most_candidates) {
        std::nth_element(heights, heights + (counts[i] - 1), heights + count);
      }
      set_column(rows, i, heights, count > most_candidates ? counts[i] : count);
    }
    HWY_DYNAMIC_DISPATCH(sort_columns)(rows);
    HWY_DYNAMIC_DISPATCH(mean_of_rows)(rows, few, most, means);
    for (std::size_t i = 0; i < batch.count(); ++i) {
      if (rows[0][i] == infinity) means[i] = height_without_seeds;
    }
  }

  for (std::size_t i = 0; i < batch.count(); ++i) {
    if (counts[i] <= most_candidates) continue;
    const std::size_t count = HWY_DYNAMIC_DISPATCH(copy_between)(batch.z(i), batch.places(i),
                                                                 floors[i], highest, heights);
    means[i] = count > 0 ? mean_of_lowest(heights, count, counts[i]) : height_without_seeds;
  }
}

}  // namespace flagstone::plane_fits
#endif

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/bin_batch.hpp"

#include <algorithm>
#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/bin_batch.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_PLANE_FITS_BIN_BATCH_ONCE
#define FLAGSTONE_PLANE_FITS_BIN_BATCH_ONCE
namespace flagstone::plane_fits {

/// Destination of the points of one bin. Elements after them can be written up to the next multiple
/// of 16, and 16 elements beyond.
struct PackedBin {
  BinBatch::Origin origin;
  float *x, *y, *z;
};

}  // namespace flagstone::plane_fits
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::plane_fits::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

HWY_INLINE void pad(const PackedBin& bin, std::size_t size) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    hn::StoreU(hn::Zero(d), d, bin.x + size + lane);
    hn::StoreU(hn::Zero(d), d, bin.y + size + lane);
    hn::StoreU(hn::Set(d, std::numeric_limits<float>::infinity()), d, bin.z + size + lane);
  }
}

/// Copies sixteen points per step. The next run overwrites the excess of the last step.
void gather_runs(const ScanPoints& scan, std::span<const Run> runs, const PackedBin& bin) {
  const FloatTag d;
  const FloatVector origin_x = hn::Set(d, bin.origin.x);
  const FloatVector origin_y = hn::Set(d, bin.origin.y);
  const float* HWY_RESTRICT from_x = scan.x();
  const float* HWY_RESTRICT from_y = scan.y();
  const float* HWY_RESTRICT from_z = scan.z();
  float* HWY_RESTRICT to_x = bin.x;
  float* HWY_RESTRICT to_y = bin.y;
  float* HWY_RESTRICT to_z = bin.z;
  std::size_t size = 0;
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < run.length; i += hn::Lanes(d)) {
      const std::size_t from = run.begin + i;
      hn::StoreU(hn::Sub(hn::LoadU(d, from_x + from), origin_x), d, to_x + size + i);
      hn::StoreU(hn::Sub(hn::LoadU(d, from_y + from), origin_y), d, to_y + size + i);
      hn::StoreU(hn::LoadU(d, from_z + from), d, to_z + size + i);
    }
    size += run.length;
  }
  pad(bin, size);
}

void gather_points(std::span<const MovedPoint> points, const PackedBin& bin) {
  const FloatTag d;
  const FloatVector origin_x = hn::Set(d, bin.origin.x);
  const FloatVector origin_y = hn::Set(d, bin.origin.y);
  const float* records = &points.data()->x;
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    FloatVector x, y, z;
    load_points<4>(records + 4 * i, x, y, z);
    hn::StoreU(hn::Sub(x, origin_x), d, bin.x + i);
    hn::StoreU(hn::Sub(y, origin_y), d, bin.y + i);
    hn::StoreU(z, d, bin.z + i);
  }
  pad(bin, points.size());
}

}  // namespace
}  // namespace flagstone::plane_fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::plane_fits {
namespace {
HWY_EXPORT(gather_runs);
HWY_EXPORT(gather_points);

BinBatch::Origin midway(float x1, float y1, float x2, float y2) {
  return {(x1 + x2) / 2, (y1 + y2) / 2};
}

}  // namespace

void BinBatch::reserve(std::size_t points) {
  const std::size_t places = points + (batch_size + 2) * 16;
  for (Buffer<float>* coordinate : {&x_, &y_, &z_}) coordinate->reserve(places);
}

void BinBatch::gather(const ScanPoints& scan, const BinGroups& groups) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    PackedBin packed{.origin = {}, .x = x(i), .y = y(i), .z = z(i)};
    if (groups.moved()) {
      const std::span<const MovedPoint> points = groups.points(bins_[i]);
      packed.origin = midway(points.front().x, points.front().y, points.back().x, points.back().y);
      HWY_DYNAMIC_DISPATCH(gather_points)(points, packed);
    } else {
      const std::span<const Run> runs = groups.runs(bins_[i]);
      const std::size_t begin = runs.front().begin;
      const std::size_t last = runs.back().begin + runs.back().length - 1;
      packed.origin = midway(scan.x()[begin], scan.y()[begin], scan.x()[last], scan.y()[last]);
      HWY_DYNAMIC_DISPATCH(gather_runs)(scan, runs, packed);
    }
    origins_[i] = packed.origin;
  }
}

}  // namespace flagstone::plane_fits
#endif

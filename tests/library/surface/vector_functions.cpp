// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/vector_functions.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/vector_functions.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/read_cloud-inl.hpp"
#include "library/surface/content_sample-inl.hpp"
#include "library/surface/square_cells-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::tests::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;           // NOLINT(google-build-using-namespace)
using namespace flagstone::surface::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace)

std::size_t length() { return hn::Lanes(FloatTag()); }

struct ListLocated {
  HWY_INLINE void operator()(std::size_t i, FloatVector x, FloatVector y, FloatVector z) const {
    const IntTag di;
    const auto point = locator.locate(x, y, z);
    HWY_ALIGN std::array<std::int32_t, lanes> cell;
    HWY_ALIGN std::array<std::int32_t, lanes> packed;
    hn::Store(point.cell, di, cell.data());
    hn::Store(point.packed, di, packed.data());
    for (std::size_t lane = 0; lane < hn::Lanes(di) && i + lane < found.size(); ++lane) {
      found[i + lane] = {.cell = static_cast<std::uint32_t>(cell[lane]),
                         .packed = static_cast<std::uint32_t>(packed[lane])};
    }
  }
  CellLocator locator;
  std::vector<Located>& found;
};

void locate_all(const CloudView& cloud, const surface::SquareCells& cells,
                std::vector<Located>& found) {
  if (cloud.size() > 0) read_cloud(cloud, 0, cloud.size(), ListLocated{CellLocator(cells), found});
}

std::size_t sample(const surface::PackedPoint* points, std::size_t count, SizeOfSample size,
                   surface::PackedPoint* sample) {
  return take_sample(points, count, SampleSize{.most = size.most, .wanted = size.wanted}, sample);
}

std::size_t sample_patch(const surface::PackedPoint* points, std::size_t count, SizeOfSample size,
                         surface::PackedPoint* sample) {
  const std::int32_t threshold = sample_threshold(
      points, count, SampleSize{.most = size.most, .wanted = size.wanted}, patch_hash);
  return copy_sample(points, count, threshold, patch_hash, count, sample);
}

}  // namespace
}  // namespace flagstone::tests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "random_cloud.hpp"

namespace flagstone::tests {
namespace {
HWY_EXPORT(length);
HWY_EXPORT(locate_all);
HWY_EXPORT(sample);
HWY_EXPORT(sample_patch);

/// Elements that vectors can read or write after the last one.
constexpr std::size_t slack = 48;

}  // namespace

std::size_t vector_length() { return HWY_DYNAMIC_DISPATCH(length)(); }

std::vector<Located> located(const std::vector<Point>& cloud, const surface::SquareCells& cells) {
  std::vector<Located> found(cloud.size());
  HWY_DYNAMIC_DISPATCH(locate_all)(view_of(cloud), cells, found);
  return found;
}

std::vector<std::uint32_t> cells_of(const std::vector<Point>& cloud,
                                    const surface::SquareCells& cells) {
  std::vector<std::uint32_t> found(cloud.size());
  std::ranges::transform(located(cloud, cells), found.begin(), &Located::cell);
  return found;
}

std::vector<surface::PackedPoint> sample_of(std::vector<surface::PackedPoint> points,
                                            SizeOfSample size) {
  const std::size_t count = points.size();
  points.resize(count + slack);
  std::vector<surface::PackedPoint> sampled(size.most + slack);
  sampled.resize(HWY_DYNAMIC_DISPATCH(sample)(points.data(), count, size, sampled.data()));
  return sampled;
}

std::vector<surface::PackedPoint> patch_sample_of(std::vector<surface::PackedPoint> points,
                                                  SizeOfSample size) {
  const std::size_t count = points.size();
  points.resize(count + slack);
  std::vector<surface::PackedPoint> sampled(size.most + slack);
  sampled.resize(HWY_DYNAMIC_DISPATCH(sample_patch)(points.data(), count, size, sampled.data()));
  return sampled;
}

}  // namespace flagstone::tests
#endif

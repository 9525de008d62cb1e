// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/slab_counts.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/slab_counts.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

void count_bins(const plane_fits::BinBatch& batch, const PlaneBatch& planes,
                std::array<SlabCounts, batch_size>& counts) {
  const FloatTag d;
  for (std::size_t bin = 0; bin < batch.count(); ++bin) {
    const FloatVector nx = hn::Set(d, static_cast<float>(planes.normal[0][bin]));
    const FloatVector ny = hn::Set(d, static_cast<float>(planes.normal[1][bin]));
    const FloatVector nz = hn::Set(d, static_cast<float>(planes.normal[2][bin]));
    const FloatVector offset = hn::Set(d, static_cast<float>(planes.d[bin]));
    const float* HWY_RESTRICT x = batch.x(bin);
    const float* HWY_RESTRICT y = batch.y(bin);
    const float* HWY_RESTRICT z = batch.z(bin);
    const std::size_t places = batch.places(bin);
    std::size_t within = 0;
    std::size_t above = 0;
    for (std::size_t i = 0; i < places; i += hn::Lanes(d)) {
      // Infinite in places without a point, or not a number where the plane is upright.
      const FloatVector distance =
          hn::Add(hn::Add(hn::Add(hn::Mul(nx, hn::Load(d, x + i)), hn::Mul(ny, hn::Load(d, y + i))),
                          hn::Mul(nz, hn::Load(d, z + i))),
                  offset);
      within += hn::CountTrue(d, hn::Lt(hn::Abs(distance), hn::Set(d, 0.125f)));
      above += hn::CountTrue(
          d, hn::And(hn::Gt(distance, hn::Set(d, 0.1875f)), hn::Lt(distance, hn::Set(d, 0.8875f))));
    }
    counts[bin] = {.within = static_cast<std::uint32_t>(within),
                   .above = static_cast<std::uint32_t>(above)};
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(count_bins);
}  // namespace

std::array<SlabCounts, batch_size> count_slabs(const plane_fits::BinBatch& batch,
                                               const PlaneBatch& planes) noexcept {
  std::array<SlabCounts, batch_size> counts{};
  HWY_DYNAMIC_DISPATCH(count_bins)(batch, planes, counts);
  return counts;
}

}  // namespace flagstone::surface
#endif

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/read_scan.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/patchwork/read_scan.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/patchwork/locate-inl.hpp"
#include "library/plane_fits/read_slice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::patchwork::HWY_NAMESPACE {
namespace {

template <bool few, bool in_view>
struct Locate {
  HWY_INLINE IntVector operator()(FloatVector x, FloatVector y, FloatVector z) const {
    return locate<few, in_view>(x, y, z, zones);
  }
  const ConcentricZones& zones;
};

std::size_t read_zones(const plane_fits::PointSlice& stretch, const ConcentricZones& zones) {
  const bool few = zones.rings().size() <= RingTree::few;
  if (zones.have_own_view()) {
    return few ? plane_fits::HWY_NAMESPACE::read_slice(stretch, Locate<true, true>{zones})
               : plane_fits::HWY_NAMESPACE::read_slice(stretch, Locate<false, true>{zones});
  }
  return few ? plane_fits::HWY_NAMESPACE::read_slice(stretch, Locate<true, false>{zones})
             : plane_fits::HWY_NAMESPACE::read_slice(stretch, Locate<false, false>{zones});
}

}  // namespace
}  // namespace flagstone::patchwork::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::patchwork {
namespace {
HWY_EXPORT(read_zones);
}  // namespace

void read_chunk(CloudView cloud, std::size_t chunk, const ConcentricZones& zones,
                plane_fits::ScanPoints& scan) noexcept {
  scan.read(cloud, chunk, [&](const plane_fits::PointSlice& stretch) {
    return HWY_DYNAMIC_DISPATCH(read_zones)(stretch, zones);
  });
}

}  // namespace flagstone::patchwork
#endif

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/read_scan.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/read_scan.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/plane_fits/read_slice-inl.hpp"
#include "library/surface/locate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

struct Locate {
  HWY_INLINE IntVector operator()(FloatVector x, FloatVector y, FloatVector z) const {
    return locate(x, y, z, cells);
  }
  const SquareCells& cells;
};

std::size_t read_cells(const plane_fits::PointSlice& stretch, const SquareCells& cells) {
  return plane_fits::HWY_NAMESPACE::read_slice(stretch, Locate{cells});
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(read_cells);
}  // namespace

void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan) noexcept {
  scan.read(cloud, chunk, [&](const plane_fits::PointSlice& stretch) {
    return HWY_DYNAMIC_DISPATCH(read_cells)(stretch, cells);
  });
}

}  // namespace flagstone::surface
#endif

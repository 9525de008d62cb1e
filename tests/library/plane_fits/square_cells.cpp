// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/square_cells.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/plane_fits/square_cells.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/plane_fits/read_slice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::tests::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

struct Locate {
  HWY_INLINE IntVector operator()(FloatVector x, FloatVector y, FloatVector z) const {
    const FloatTag d;
    const IntTag di;
    const FloatVector width = hn::Set(d, static_cast<float>(cells.width));
    const FloatVector half = hn::Set(d, static_cast<float>(cells.width) / 2);
    const FloatVector scale = hn::Set(d, 1 / cells.cell);
    const FloatVector column = hn::Add(hn::Mul(x, scale), half);
    const FloatVector row = hn::Add(hn::Mul(y, scale), half);
    const FloatVector zero = hn::Zero(d);
    const auto inside = hn::And(hn::And(hn::Ge(column, zero), hn::Lt(column, width)),
                                hn::And(hn::Ge(row, zero), hn::Lt(row, width)));
    const auto valid = hn::And(inside, hn::Eq(hn::Mul(z, zero), zero));
    const IntVector cell = hn::Add(hn::Mul(whole_part(hn::IfThenElseZero(valid, row)),
                                           hn::Set(di, static_cast<std::int32_t>(cells.width))),
                                   whole_part(hn::IfThenElseZero(valid, column)));
    return hn::IfThenElse(hn::RebindMask(di, valid), cell,
                          hn::Set(di, static_cast<std::int32_t>(cells.outside())));
  }
  const SquareCells& cells;
};

std::size_t read_cells(const plane_fits::PointSlice& slice, const SquareCells& cells) {
  return plane_fits::HWY_NAMESPACE::read_slice(slice, Locate{cells});
}

}  // namespace
}  // namespace flagstone::tests::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <cmath>

namespace flagstone::tests {
namespace {
HWY_EXPORT(read_cells);
}  // namespace

std::uint32_t SquareCells::cell_of(const Point& point) const {
  const float scale = 1 / cell;
  const float half = static_cast<float>(width) / 2;
  const float column = point.x * scale + half;
  const float row = point.y * scale + half;
  const auto in = [&](float v) { return v >= 0 && v < static_cast<float>(width); };
  if (!in(column) || !in(row) || !std::isfinite(point.z)) return outside();
  return static_cast<std::uint32_t>(row) * width + static_cast<std::uint32_t>(column);
}

void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan) {
  scan.read(cloud, chunk, [&](const plane_fits::PointSlice& slice) {
    return HWY_DYNAMIC_DISPATCH(read_cells)(slice, cells);
  });
}

}  // namespace flagstone::tests
#endif

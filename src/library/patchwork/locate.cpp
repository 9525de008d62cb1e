// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "library/patchwork/concentric_zones.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/patchwork/locate.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/patchwork/locate-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::patchwork::HWY_NAMESPACE {
namespace {

template <bool few, bool in_view>
void locate_all(const ConcentricZones& zones, const float* x, const float* y, const float* z,
                std::size_t count, std::uint32_t* bins) {
  const FloatTag d;
  const IntTag di;
  const auto locate_vector = [&](const float* vx, const float* vy, const float* vz,
                                 std::uint32_t* out) HWY_ATTR {
    const IntVector found =
        locate<few, in_view>(hn::LoadU(d, vx), hn::LoadU(d, vy), hn::LoadU(d, vz), zones);
    hn::StoreU(found, di, reinterpret_cast<std::int32_t*>(out));
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) locate_vector(x + i, y + i, z + i, bins + i);

  std::array<std::array<float, lanes>, 3> rest{};
  std::array<std::uint32_t, lanes> bins_of_rest{};
  std::copy(x + i, x + count, rest[0].begin());
  std::copy(y + i, y + count, rest[1].begin());
  std::copy(z + i, z + count, rest[2].begin());
  locate_vector(rest[0].data(), rest[1].data(), rest[2].data(), bins_of_rest.data());
  std::copy_n(bins_of_rest.begin(), count - i, bins + i);
}

void locate_points(const ConcentricZones& zones, const float* x, const float* y, const float* z,
                   std::size_t count, std::uint32_t* bins) {
  const bool few = zones.rings().size() <= RingTree::few;
  const auto locate = zones.have_own_view()
                          ? (few ? locate_all<true, true> : locate_all<false, true>)
                          : (few ? locate_all<true, false> : locate_all<false, false>);
  locate(zones, x, y, z, count, bins);
}

}  // namespace
}  // namespace flagstone::patchwork::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::patchwork {
namespace {
HWY_EXPORT(locate_points);
}  // namespace

void ConcentricZones::locate(const float* x, const float* y, const float* z, std::size_t count,
                             std::uint32_t* bins) const noexcept {
  HWY_DYNAMIC_DISPATCH(locate_points)(*this, x, y, z, count, bins);
}

}  // namespace flagstone::patchwork
#endif

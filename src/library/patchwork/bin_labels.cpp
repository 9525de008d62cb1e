// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/bin_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "library/core/plane.hpp"
#include "library/plane_fits/lower_plane.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/patchwork/bin_labels.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/plane_fits/ground_set-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::patchwork::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half
using namespace flagstone::plane_fits::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): sets

/// Eq. (12): writes the labels of the points of a bin in packed order, one byte per element. Points
/// in the final ground set are ground.
LabelCounts label_bin(const plane_fits::BinBatch& batch, std::size_t bin,
                      const plane_fits::GroundSet& set, std::uint8_t* HWY_RESTRICT labels) {
  const FloatTag d;
  const IntTag di;
  const hn::Rebind<std::uint8_t, FloatTag> d8;
  const std::size_t places = batch.places(bin);
  std::size_t ground = 0;
  std::size_t ground_or_noise = 0;
  for (std::size_t i = 0; i < places; i += hn::Lanes(d)) {
    const FloatVector h = height(d, hn::Load(d, batch.x(bin) + i), hn::Load(d, batch.y(bin) + i),
                                 hn::Load(d, batch.z(bin) + i), set);
    const auto below_top = hn::Lt(h, hn::Set(d, set.top));
    const auto in_set = hn::And(below_top, hn::Ge(h, hn::Set(d, set.bottom)));
    ground += hn::CountTrue(d, in_set);
    ground_or_noise += hn::CountTrue(d, below_top);
    const IntVector below =
        hn::IfThenElse(hn::RebindMask(di, in_set), hn::Set(di, static_cast<int>(Label::ground)),
                       hn::Set(di, static_cast<int>(Label::noise)));
    const IntVector label = hn::IfThenElseZero(hn::RebindMask(di, below_top), below);
    hn::StoreU(hn::DemoteTo(d8, label), d8, labels + i);
  }
  return {.ground = static_cast<std::uint32_t>(ground),
          .noise = static_cast<std::uint32_t>(ground_or_noise - ground)};
}

#if HWY_TARGET <= HWY_AVX3

/// Copies the labels of a run, up to 64 at once. Never writes a byte outside the run, because its
/// neighbours may belong to another thread.
HWY_INLINE void copy_run(const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
  const hn::ScalableTag<std::uint8_t> d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    hn::BlendedStore(hn::LoadU(d, from + i), hn::FirstN(d, count - i), d, to + i);
  }
}

#else

template <std::size_t size>
HWY_INLINE void copy_ends(const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
  std::memcpy(to, from, size);
  std::memcpy(to + count - size, from + count - size, size);
}

/// Copies the labels of a run. Most runs are short, and a memcpy of unknown size is slow for them.
HWY_INLINE void copy_run(const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
  if (count >= 16) {
    for (std::size_t i = 0; i + 16 <= count; i += 16) std::memcpy(to + i, from + i, 16);
    std::memcpy(to + count - 16, from + count - 16, 16);
  } else if (count >= 8) {
    copy_ends<8>(from, count, to);
  } else if (count >= 4) {
    copy_ends<4>(from, count, to);
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
  }
}

#endif

void copy_runs(const std::uint8_t* from, std::span<const plane_fits::Run> runs,
               std::uint8_t* labels) {
  for (const plane_fits::Run& run : runs) {
    copy_run(from, run.length, labels + run.begin);
    from += run.length;
  }
}

}  // namespace
}  // namespace flagstone::patchwork::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::patchwork {
namespace {
HWY_EXPORT(label_bin);
HWY_EXPORT(copy_runs);

/// Labels noise points of a bin that form a separate plane as ground. Returns their number. Uses
/// double precision, because few bins have such points.
std::uint32_t label_lower_ground(const plane_fits::BinBatch& batch, std::size_t bin,
                                 std::uint8_t* labels) {
  const auto each_deep = [&](const auto& work) {
    for (std::size_t i = 0; i < batch.size(bin); ++i) {
      if (labels[i] != static_cast<std::uint8_t>(Label::noise)) continue;
      work(i, Vector3{batch.x(bin)[i], batch.y(bin)[i], batch.z(bin)[i]});
    }
  };
  Moments moments;
  each_deep([&](std::size_t, const Vector3& p) { moments.add(p[0], p[1], p[2]); });
  const double deep = moments.count;
  Plane plane = plane_of(moments);
  for (const double margin : plane_fits::sunken_fit_margins) {
    moments = {};
    each_deep([&](std::size_t, const Vector3& p) {
      if (std::abs(plane_fits::height_above(plane, p)) < margin) moments.add(p[0], p[1], p[2]);
    });
    if (moments.count < plane_fits::fewest_sunken_points) return 0;
    plane = plane_of(moments);
  }
  if (!plane_fits::is_lower_ground(plane, deep)) return 0;
  std::uint32_t found = 0;
  each_deep([&](std::size_t i, const Vector3& p) {
    if (std::abs(plane_fits::height_above(plane, p)) >= plane_fits::sunken_margin) return;
    labels[i] = static_cast<std::uint8_t>(Label::ground);
    ++found;
  });
  return found;
}

}  // namespace

LabelCounts BinLabels::write(const plane_fits::BinBatch& batch, std::size_t i,
                             plane_fits::GroundSet set, const plane_fits::BinGroups& groups,
                             std::span<Label> labels) noexcept {
  set.bottom = std::max(set.bottom, set.top - depth_);
  std::uint8_t* packed = packed_.data();
  LabelCounts counts = HWY_DYNAMIC_DISPATCH(label_bin)(batch, i, set, packed);
  if (finds_lower_ground_ && counts.noise >= plane_fits::fewest_sunken_points) {
    counts.lower_ground = label_lower_ground(batch, i, packed);
    counts.ground += counts.lower_ground;
    counts.noise -= counts.lower_ground;
  }
  if (groups.moved()) {
    for (const plane_fits::MovedPoint& point : groups.points(batch.bin(i))) {
      labels[point.index] = static_cast<Label>(*packed++);
    }
  } else {
    HWY_DYNAMIC_DISPATCH(copy_runs)
    (packed, groups.runs(batch.bin(i)), reinterpret_cast<std::uint8_t*>(labels.data()));
  }
  return counts;
}

std::uint32_t BinLabels::fill(const plane_fits::BinGroups& groups, std::uint32_t bin, Label label,
                              std::span<Label> labels) noexcept {
  if (groups.moved()) {
    for (const plane_fits::MovedPoint& point : groups.points(bin)) labels[point.index] = label;
  } else {
    for (const plane_fits::Run& run : groups.runs(bin)) {
      std::fill_n(labels.data() + run.begin, run.length, label);
    }
  }
  return groups.size(bin);
}

}  // namespace flagstone::patchwork
#endif

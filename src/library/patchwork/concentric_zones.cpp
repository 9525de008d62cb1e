// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/concentric_zones.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "library/core/mounting_height.hpp"
#include "library/core/point_validity.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/patchwork/concentric_zones.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h includes this file once per instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/plane_fits/read_slice-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace flagstone::patchwork::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

/// theta of eq. (3), counted from -pi, as a fraction of a full turn: 0 to 1, with an error of at
/// most 1e-7. Exact on the axes and diagonals, where sectors begin; NaN at the origin. Uses only +
/// - * /, so that results are bit-identical on every instruction set.
HWY_INLINE FloatVector turn_of(FloatVector x, FloatVector y) {
  const FloatTag d;
  const FloatVector ax = hn::Abs(x);
  const FloatVector ay = hn::Abs(y);
  // arctan(t) / 2 pi on [0, 1]: odd polynomial with a maximum error of 6e-8 before rounding, and
  // exactly 1/8 at t = 1.
  const FloatVector t = hn::Div(hn::Min(ax, ay), hn::Max(ax, ay));
  const FloatVector t2 = hn::Mul(t, t);
  FloatVector p = hn::Set(d, 0.001084128f);
  for (const float coefficient :
       {-0.005348304f, 0.012672494f, -0.021061514f, 0.031525116f, -0.053026237f, 0.15915433f}) {
    p = hn::Add(hn::Mul(p, t2), hn::Set(d, coefficient));
  }
  const FloatVector eighth = hn::Mul(p, t);
  const FloatVector quarter =
      hn::IfThenElse(hn::Gt(ax, ay), eighth, hn::Sub(hn::Set(d, 0.25f), eighth));
  const FloatVector half =
      hn::IfThenElse(hn::Lt(x, hn::Zero(d)), hn::Sub(hn::Set(d, 0.5f), quarter), quarter);
  return hn::Add(hn::Set(d, 0.5f), hn::CopySignToAbs(half, y));
}

/// The ring that contains rho^2, eqs. (2) and (3), found by descending the tree. `few`: there are
/// at most 16 rings, so that all tables fit into registers.
template <bool few>
HWY_INLINE IntVector ring_of(FloatVector squared_range, const RingTree& tree) {
  const FloatTag d;
  const IntTag di;
  const auto step = [&](IntVector node, FloatVector boundary) HWY_ATTR {
    const IntVector left = hn::Add(node, node);
    const auto right = hn::RebindMask(di, hn::Ge(squared_range, boundary));
    return increment_if(right, left);
  };
  const std::vector<float>* level = tree.boundaries.data();
  IntVector node = step(hn::Zero(di), hn::Set(d, level[0][0]));
  for (std::size_t l = 1; l < 4; ++l) node = step(node, Table8<FloatTag>(level[l].data())[node]);
  if constexpr (!few) {
    node = step(node, lookup_16(level[4].data(), node));  // 17 or more rings have a fifth level
    for (std::size_t l = 5; l < tree.boundaries.size(); ++l) {
      node = step(node, hn::GatherIndex(d, level[l].data(), node));
    }
  }
  return node;
}

template <bool few>
HWY_INLINE FloatVector of_ring(const float* table, IntVector ring) {
  if constexpr (few) {
    return lookup_16(table, ring);
  } else {
    return hn::GatherIndex(FloatTag(), table, ring);
  }
}

HWY_INLINE IntVector all_lanes(std::uint32_t bin) {
  return hn::Set(IntTag(), static_cast<std::int32_t>(bin));
}

/// Replaces the bins of points without a bin by out_of_range() or invalid().
HWY_INLINE IntVector with_binless(IntVector bins, FloatVector squared_range, FloatVector x,
                                  FloatVector y, FloatVector z, const ConcentricZones& zones) {
  const FloatTag d;
  const IntTag di;
  const auto valid = is_valid(x, y, z);
  const auto in_range =
      hn::And(hn::And(hn::Ge(squared_range, hn::Set(d, zones.min_squared_range())),
                      hn::Lt(squared_range, hn::Set(d, zones.max_squared_range()))),
              hn::Le(hn::Abs(z), hn::Set(d, max_coordinate)));
  const IntVector binless = hn::IfThenElse(
      hn::RebindMask(di, valid), all_lanes(zones.out_of_range()), all_lanes(zones.invalid()));
  return hn::IfThenElse(hn::RebindMask(di, hn::And(in_range, valid)), bins, binless);
}

/// Position within the field of view, as a fraction of its width: below 1 inside, 1 or more
/// outside. `turn` is a result of turn_of.
HWY_INLINE FloatVector share_of_view(FloatVector turn, const ConcentricZones& zones) {
  const FloatTag d;
  const FloatVector one = hn::Set(d, 1.0f);
  const FloatVector once = hn::IfThenElseZero(hn::Lt(turn, one), turn);  // theta = pi counts as -pi
  const FloatVector beyond = hn::Sub(once, hn::Set(d, zones.begin_turn()));
  // Directions just before the start are almost a full turn after it; rounding must not reach 1.
  const FloatVector before = hn::Min(hn::Add(beyond, one), hn::Set(d, 1 - 0x1p-24f));
  const FloatVector from_begin = hn::IfThenElse(hn::Lt(beyond, hn::Zero(d)), before, beyond);
  return hn::Div(from_begin, hn::Set(d, zones.turns()));
}

/// Sector j of eq. (3); theta = pi counts as -pi.
HWY_INLINE IntVector sector_of(FloatVector turn, FloatVector sectors) {
  const FloatVector turns = hn::Mul(turn, sectors);
  return whole_part(hn::IfThenElseZero(hn::Lt(turns, sectors), turns));
}

/// Sector within a field of view. Rounding must not lead past the last sector.
HWY_INLINE IntVector sector_of_view(FloatVector share, FloatVector sectors) {
  const FloatVector last = hn::Sub(sectors, hn::Set(FloatTag(), 1.0f));
  const FloatVector sector = hn::Mul(share, sectors);
  return whole_part(hn::IfThenElse(hn::Lt(sector, sectors), sector, last));
}

/// The bins of points: each is a bin, noise(), out_of_range() or invalid(). Coordinates may have
/// any value, including NaN, infinity and denormals. `in_view`: the zones have a limited field of
/// view; otherwise sector 0 begins at theta = -pi.
template <bool few, bool in_view>
HWY_INLINE IntVector locate(FloatVector x, FloatVector y, FloatVector z,
                            const ConcentricZones& zones) {
  const FloatTag d;
  const IntTag di;
  const FloatVector squared_range = hn::Add(hn::Mul(x, x), hn::Mul(y, y));  // can be infinite
  const IntVector ring = ring_of<few>(squared_range, zones.tree());

  const FloatVector sectors = of_ring<few>(zones.sectors(), ring);
  FloatVector turn = turn_of(x, y);
  if constexpr (in_view) turn = share_of_view(turn, zones);
  const IntVector sector = in_view ? sector_of_view(turn, sectors) : sector_of(turn, sectors);
  const FloatVector first_bin = of_ring<few>(zones.first_bins(), ring);
  IntVector bins = hn::Add(hn::BitCast(di, first_bin), sector);

  const auto noise = hn::Lt(z, of_ring<few>(zones.noise_heights(), ring));
  bins = hn::IfThenElse(hn::RebindMask(di, noise), all_lanes(zones.noise()), bins);
  if constexpr (in_view) {
    const auto seen = hn::Lt(turn, hn::Set(d, 1.0f));
    bins = hn::IfThenElse(hn::RebindMask(di, seen), bins, all_lanes(zones.out_of_range()));
  }

  // Points straight above or below the sensor also take this slow path.
  const auto in_range =
      hn::And(hn::And(hn::Ge(squared_range, hn::Set(d, zones.least_squared_range())),
                      hn::Lt(squared_range, hn::Set(d, zones.max_squared_range()))),
              hn::Le(hn::Abs(z), hn::Set(d, max_coordinate)));
  if (HWY_UNLIKELY(!hn::AllTrue(d, in_range))) {
    bins = with_binless(bins, squared_range, x, y, z, zones);
  }
  return bins;
}

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

static_assert(most_bins + 3 <
              1U << plane_fits::bin_bits);  // bins and the values for points without a bin

namespace {
HWY_EXPORT(locate_points);
HWY_EXPORT(read_zones);

float squared(float radius) {
  return static_cast<float>(static_cast<double>(radius) * static_cast<double>(radius));
}

/// M_h * h_s, metres. If the origin is not at the sensor, the height at the same depth below the
/// ground.
double seed_floor(double margin, float sensor_height) {
  if (std::isinf(margin)) return margin;  // no limit, whatever the height
  if (sensor_height > 0) return margin * sensor_height;
  return -double{sensor_height} + (margin + 1) * mounting_height(sensor_height);
}

}  // namespace

ConcentricZones::ConcentricZones(const PatchworkConfig& config) {
  const double begin = config.field_of_view.begin / 360.0 + 0.5;
  begin_turn_ = static_cast<float>(begin - std::floor(begin));
  if (begin_turn_ == 1) begin_turn_ = 0;
  turns_ = config.field_of_view.width / 360;
  squared_radii_.push_back(squared(config.min_range));
  for (std::size_t zone = 0; zone < config.zones.size(); ++zone) {
    for (std::size_t ring = 0; ring < config.zones[zone].ring_radii.size(); ++ring) {
      add_ring(config, zone, ring);
    }
  }
  least_squared_range_ = std::max(squared_radii_.front(), std::numeric_limits<float>::min());
  // If rho^2 is infinite, the tree leads to its last leaf, even if that is not a ring.
  const std::size_t table_size = std::max(std::bit_ceil(rings_.size()), RingTree::few);
  for (std::vector<float>* table : {&sectors_, &first_bins_, &noise_heights_}) {
    table->resize(table_size);
  }
  grow_tree();
}

/// Eq. (2): adds the rings of the zones from the inside out.
void ConcentricZones::add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring) {
  const float inner = std::sqrt(squared_radii_.back());
  const float outer = config.zones[zone].ring_radii[ring];
  const int sectors = config.zones[zone].sectors;
  rings_.push_back(
      {.zone = static_cast<std::uint16_t>(zone),
       .ring = static_cast<std::uint16_t>(ring),
       .sectors = static_cast<std::uint16_t>(sectors),
       .first_bin = bin_count_,
       .seed_floor = seed_floor(config.zones[zone].height_margin, config.sensor_height),
       .center_radius = (inner + outer) / 2});
  sectors_.push_back(static_cast<float>(sectors));
  first_bins_.push_back(std::bit_cast<float>(bin_count_));
  noise_heights_.push_back(-config.sensor_height - config.noise_depth - config.noise_slope * outer);
  bin_count_ += static_cast<std::uint32_t>(sectors);
  squared_radii_.push_back(squared(outer));
}

void ConcentricZones::grow_tree() {
  const std::size_t leaves = std::max(std::bit_ceil(rings_.size()), RingTree::few);
  for (std::size_t width = leaves; width > 1; width /= 2) {
    std::vector<float>& level = tree_.boundaries.emplace_back();
    for (std::size_t begin = 0; begin < leaves; begin += width) {
      const std::size_t ring = begin + width / 2;  // the first ring of the right half
      level.push_back(ring < rings_.size() ? squared_radii_[ring]
                                           : std::numeric_limits<float>::infinity());
    }
    level.resize(std::max<std::size_t>(level.size(), 16));
  }
}

void ConcentricZones::locate(const float* x, const float* y, const float* z, std::size_t count,
                             std::uint32_t* bins) const noexcept {
  HWY_DYNAMIC_DISPATCH(locate_points)(*this, x, y, z, count, bins);
}

void read_chunk(CloudView cloud, std::size_t chunk, const ConcentricZones& zones,
                plane_fits::ScanPoints& scan) noexcept {
  scan.read(cloud, chunk, [&](const plane_fits::PointSlice& stretch) {
    return HWY_DYNAMIC_DISPATCH(read_zones)(stretch, zones);
  });
}

}  // namespace flagstone::patchwork
#endif

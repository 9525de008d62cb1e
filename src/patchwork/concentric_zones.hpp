// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::patchwork {

/// Farther above or below the sensor a coordinate is no height: the point is out of range, metres.
inline constexpr float max_height = 10000;

/// One ring of bins, with everything that its bins share.
struct Ring {
  std::uint16_t zone;           ///< m - 1
  std::uint16_t ring;           ///< i - 1, within the zone
  std::uint16_t sectors;        ///< N_theta,m
  std::uint32_t first_bin;      ///< bin of sector 0; the others follow
  std::uint32_t first_heading;  ///< where this zone's sector boundaries begin in the heading table
  float sectors_per_radian;     ///< N_theta,m / 2 pi
  float noise_height;           ///< lower points are noise, metres
  float center_radius;          ///< r_n: distance from the origin to the centre of the bins, metres
};

/// The Concentric Zone Model, section III-B, eqs. (1) and (2): which bin S_i,j,m a point falls
/// into.
///
/// No square root and no arc tangent is taken per point. A table indexed by the leading bits of
/// r^2 gives the ring up to the boundaries within one table cell, which are then compared exactly.
/// A crude arc tangent gives the nearest sector boundary, and the sign of one cross product says on
/// which side of it the point lies. The guesses decide nothing, so that their rounding cannot be
/// seen.
class ConcentricZones {
 public:
  explicit ConcentricZones(const PatchworkConfig& config);

  /// Bins in all: N_C.
  [[nodiscard]] std::uint32_t bin_count() const noexcept { return bin_count_; }

  /// What `locate` gives, beyond bins, for points that have none.
  [[nodiscard]] std::uint32_t noise() const noexcept { return bin_count_; }
  [[nodiscard]] std::uint32_t out_of_range() const noexcept { return bin_count_ + 1; }
  [[nodiscard]] std::uint32_t invalid() const noexcept { return bin_count_ + 2; }

  [[nodiscard]] const std::vector<Ring>& rings() const noexcept { return rings_; }

  /// The bin of a point, or noise(), out_of_range() or invalid(). Takes any bit pattern.
  [[nodiscard]] std::uint32_t locate(Point p) const noexcept {
    const bool finite = p.x * 0 + p.y * 0 + p.z * 0 == 0;  // infinity * 0 and NaN are NaN
    if (!finite || (p.x == 0 && p.y == 0 && p.z == 0)) return invalid();

    const float squared_range = p.x * p.x + p.y * p.y;  // rho^2, infinite where it overflows
    if (!(squared_range >= squared_radii_.front() && squared_range < squared_radii_.back() &&
          std::abs(p.z) <= max_height)) {
      return out_of_range();
    }
    const Ring& ring = rings_[ring_of(squared_range)];
    if (p.z < ring.noise_height) return noise();
    return ring.first_bin + sector_of(p.x, p.y, ring);
  }

 private:
  /// A table cell is 1/16 of an octave of r^2, about 2 % of r.
  static constexpr int cell_shift = 19;

  struct Heading {
    float x, y;  ///< unit vector
  };

  void add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring,
                std::uint32_t first_heading);
  void add_headings(int sectors);
  void fill_ring_table();

  [[nodiscard]] std::uint32_t ring_of(float squared_range) const noexcept {
    const std::uint32_t cell = std::bit_cast<std::uint32_t>(squared_range) >> cell_shift;
    std::uint32_t ring = ring_table_[cell - first_cell_];
    while (squared_range >= squared_radii_[ring + 1]) ++ring;
    return ring;
  }

  /// Sector j - 1 of eq. (2): theta from -pi (inclusive) to pi; theta = pi itself counts as -pi.
  [[nodiscard]] std::uint32_t sector_of(float x, float y, const Ring& ring) const noexcept {
    constexpr float pi = 3.14159265f;
    const float turn = (rough_angle(x, y) + pi) * ring.sectors_per_radian;
    const auto nearest = static_cast<std::int32_t>(turn + 0.5f);
    const Heading boundary = headings_[ring.first_heading + static_cast<std::uint32_t>(nearest)];
    const bool before = boundary.x * y - boundary.y * x < 0;
    const std::int32_t sector = nearest - static_cast<std::int32_t>(before);
    const std::int32_t sectors = ring.sectors;
    if (sector < 0) return static_cast<std::uint32_t>(sector + sectors);
    return static_cast<std::uint32_t>(sector < sectors ? sector : sector - sectors);
  }

  /// atan2(y, x) within 2e-4 rad, -pi to pi; the odd polynomial 4.4.49 of Abramowitz and Stegun,
  /// cut short. A sector is at least 2 pi / 3,600 = 1.7e-3 wide.
  static float rough_angle(float x, float y) noexcept {
    const float ax = std::abs(x);
    const float ay = std::abs(y);
    const float longer = std::max(ax, ay);
    const float t = longer > 0 ? std::min(ax, ay) / longer : 0;
    const float t2 = t * t;
    float angle =
        t * (0.9998660f +
             t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
    if (ay > ax) angle = 1.57079633f - angle;
    if (x < 0) angle = 3.14159265f - angle;
    return y < 0 ? -angle : angle;
  }

  std::vector<Ring> rings_;
  std::vector<float> squared_radii_;       ///< L_min^2 and each ring's outer radius squared, m^2
  std::vector<std::uint16_t> ring_table_;  ///< ring in which a cell of r^2 begins
  std::uint32_t first_cell_ = 0;
  std::vector<Heading> headings_;  ///< sector boundaries of each zone, from -pi to pi
  std::uint32_t bin_count_ = 0;
};

}  // namespace flagstone::patchwork

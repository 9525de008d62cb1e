// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
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

  /// Points that are located together, so that the compiler can do several at once.
  static constexpr std::size_t block_size = 64;

  /// The bins of `count` <= block_size points, each a bin, noise(), out_of_range() or invalid().
  /// Takes any bit pattern.
  void locate(const float* x, const float* y, const float* z, std::size_t count,
              std::uint32_t* bins) const noexcept {
    std::array<float, block_size> squared_range;  // rho^2, infinite where it overflows
    std::array<float, block_size> turn;           // theta, from -pi on, as a share of a full turn
    for (std::size_t k = 0; k < count; ++k) squared_range[k] = x[k] * x[k] + y[k] * y[k];
    for (std::size_t k = 0; k < count; ++k) turn[k] = rough_turn(x[k], y[k]);
    for (std::size_t k = 0; k < count; ++k) {
      bins[k] = bin_of(x[k], y[k], z[k], squared_range[k], turn[k]);
    }
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

  [[nodiscard]] std::uint32_t bin_of(float x, float y, float z, float squared_range,
                                     float turn) const noexcept {
    const bool in_range = squared_range >= squared_radii_.front() &&
                          squared_range < squared_radii_.back() && std::abs(z) <= max_height;
    if (!in_range) return without_bin({x, y, z});
    const Ring& ring = rings_[ring_of(squared_range)];
    if (z < ring.noise_height) return noise();
    if (x == 0 && y == 0 && z == 0) return invalid();  // within range only if that begins at 0
    return ring.first_bin + sector_of(x, y, turn, ring);
  }

  [[nodiscard]] std::uint32_t without_bin(Point p) const noexcept {
    const bool finite = p.x * 0 + p.y * 0 + p.z * 0 == 0;  // infinity * 0 and NaN are NaN
    const bool zero = p.x == 0 && p.y == 0 && p.z == 0;
    return zero || !finite ? invalid() : out_of_range();
  }

  /// Sector j - 1 of eq. (2): theta from -pi (inclusive) to pi; theta = pi itself counts as -pi.
  [[nodiscard]] std::uint32_t sector_of(float x, float y, float turn,
                                        const Ring& ring) const noexcept {
    const std::int32_t sectors = ring.sectors;
    // Not lround(): turn is not negative, and a boundary too far is what the cross product sees.
    const float rounded = turn * static_cast<float>(sectors) + 0.5f;
    const auto nearest = static_cast<std::int32_t>(rounded);
    const Heading boundary = headings_[ring.first_heading + static_cast<std::uint32_t>(nearest)];
    const bool before = boundary.x * y - boundary.y * x < 0;
    std::int32_t sector = nearest - static_cast<std::int32_t>(before);
    sector += sector < 0 ? sectors : 0;
    sector -= sector < sectors ? 0 : sectors;
    return static_cast<std::uint32_t>(sector);
  }

  /// (atan2(y, x) + pi) / 2 pi within 3e-5, 0 to 1; without branches. The odd polynomial 4.4.49 of
  /// Abramowitz and Stegun, cut short. A sector is at least 1 / 3,600 = 2.8e-4 wide.
  static float rough_turn(float x, float y) noexcept {
    constexpr float pi = std::numbers::pi_v<float>;
    const float ax = std::abs(x);
    const float ay = std::abs(y);
    const float longer = ax > ay ? ax : ay;
    const float shorter = ax > ay ? ay : ax;
    const float t = shorter / (longer + 1e-30f);
    const float t2 = t * t;
    const float first =
        t * (0.9998660f +
             t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
    const float from_y = pi / 2 - first;
    const float quadrant = ax > ay ? first : from_y;
    const float from_minus_x = pi - quadrant;
    const float half = x < 0 ? from_minus_x : quadrant;
    return 0.5f + std::copysign(half, y) * (0.5f / pi);
  }

  std::vector<Ring> rings_;
  std::vector<float> squared_radii_;       ///< L_min^2 and each ring's outer radius squared, m^2
  std::vector<std::uint16_t> ring_table_;  ///< ring in which a cell of r^2 begins
  std::uint32_t first_cell_ = 0;
  std::vector<Heading> headings_;  ///< sector boundaries of each zone, from -pi to pi
  std::uint32_t bin_count_ = 0;
};

}  // namespace flagstone::patchwork

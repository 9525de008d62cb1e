// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork_config.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::patchwork {

/// Maximum number of bins; PatchworkConfig::check() enforces it.
inline constexpr std::uint32_t most_bins = 65535;

/// One ring of bins, with the values common to its bins.
struct Ring {
  std::uint16_t zone;       ///< m - 1
  std::uint16_t ring;       ///< i - 1, within the zone
  std::uint16_t sectors;    ///< N_theta,m
  std::uint32_t first_bin;  ///< bin of sector 0; the other bins follow
  double seed_floor;        ///< minimum height of a seed of eq. (5), metres
  float center_radius;      ///< r_n: distance from the origin to the centre of the bins, metres
};

/// A binary tree over the boundaries of the rings. One comparison per level leads from the root to
/// the ring of a point. Node p of level l is `boundaries[l][p]`: points with rho^2 at or above this
/// value belong to its right half. Each level has at least 16 elements, so that it can be looked up
/// in vector registers.
struct RingTree {
  std::vector<std::vector<float>> boundaries;

  /// Up to this many rings, four levels and the tables of the rings fit into vector registers.
  static constexpr std::size_t few = 16;
};

/// The Concentric Zone Model, section III-B: zones Z_m with rings and sectors, eqs. (2) and (3),
/// stored as tables.
class ConcentricZones {
 public:
  explicit ConcentricZones(const PatchworkConfig& config);

  /// N_C: number of bins in all zones.
  [[nodiscard]] std::uint32_t bin_count() const noexcept { return bin_count_; }

  /// Finds the bins of `count` points. Each result is a bin, noise(), out_of_range() or invalid().
  /// Coordinates may have any value, including NaN, infinity and denormals.
  void locate(const float* x, const float* y, const float* z, std::size_t count,
              std::uint32_t* bins) const noexcept;

  /// Values for points without a bin.
  [[nodiscard]] std::uint32_t noise() const noexcept { return bin_count_; }
  [[nodiscard]] std::uint32_t out_of_range() const noexcept { return bin_count_ + 1; }
  [[nodiscard]] std::uint32_t invalid() const noexcept { return bin_count_ + 2; }

  /// Number of bins plus the three values for points without a bin.
  [[nodiscard]] std::uint32_t group_count() const noexcept { return bin_count_ + 3; }

  [[nodiscard]] const std::vector<Ring>& rings() const noexcept { return rings_; }

  /// L_min^2 and L_max^2.
  [[nodiscard]] float min_squared_range() const noexcept { return squared_radii_.front(); }
  /// L_min^2, or the smallest normal number if that is larger.
  [[nodiscard]] float least_squared_range() const noexcept { return least_squared_range_; }
  [[nodiscard]] float max_squared_range() const noexcept { return squared_radii_.back(); }

  /// True if the sectors do not start at theta = -pi or do not cover the full circle.
  [[nodiscard]] bool have_own_view() const noexcept { return begin_turn_ != 0 || turns_ != 1; }
  /// Start of sector 0, counted from theta = -pi, as a fraction of a full turn: 0 to below 1.
  [[nodiscard]] float begin_turn() const noexcept { return begin_turn_; }
  /// Fraction of the full circle that the zones cover, above 0, up to 1.
  [[nodiscard]] float turns() const noexcept { return turns_; }

  [[nodiscard]] const RingTree& tree() const noexcept { return tree_; }

  /// @name Tables by ring
  /// One element per leaf of the tree.
  /// @{
  [[nodiscard]] const float* sectors() const noexcept { return sectors_.data(); }
  /// Integers, stored bit by bit in floats.
  [[nodiscard]] const float* first_bins() const noexcept { return first_bins_.data(); }
  /// Points below these heights are noise, metres.
  [[nodiscard]] const float* noise_heights() const noexcept { return noise_heights_.data(); }
  /// @}

 private:
  void add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring);
  void grow_tree();

  std::vector<Ring> rings_;
  std::vector<float> squared_radii_;  ///< L_min^2 and the squared outer radius of each ring, m^2
  float least_squared_range_ = 0;
  float begin_turn_ = 0;
  float turns_ = 1;
  std::vector<float> sectors_;
  std::vector<float> first_bins_;
  std::vector<float> noise_heights_;
  RingTree tree_;
  std::uint32_t bin_count_ = 0;
};

/// Reads chunk `chunk` of the cloud into `scan`, with the bin of each point in the Concentric Zone
/// Model, noise(), out_of_range() or invalid(). `scan` must have enough memory reserved. Several
/// threads can read different chunks at once.
void read_chunk(CloudView cloud, std::size_t chunk, const ConcentricZones& zones,
                plane_fits::ScanPoints& scan) noexcept;

}  // namespace flagstone::patchwork

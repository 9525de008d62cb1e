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

/// As many bins as PatchworkConfig::check() allows.
inline constexpr std::uint32_t most_bins = 65535;

/// One ring of bins, with everything that its bins share.
struct Ring {
  std::uint16_t zone;       ///< m - 1
  std::uint16_t ring;       ///< i - 1, within the zone
  std::uint16_t sectors;    ///< N_theta,m
  std::uint32_t first_bin;  ///< bin of sector 0; the others follow
  double seed_floor;        ///< no seed of eq. (5) is lower, metres
  float center_radius;      ///< r_n: distance from the origin to the centre of the bins, metres
};

/// A binary tree over the rings' boundaries: as many steps as it has levels lead from the root to
/// the ring of a point, with one comparison each. Node p of level l stands at
/// `boundaries[l][p]`: rho^2 from which on a point belongs to its right half. A level takes at
/// least 16 places, so that it can be looked up in vector registers.
struct RingTree {
  std::vector<std::vector<float>> boundaries;

  /// Up to this many rings four levels and the tables of the rings fit vector registers.
  static constexpr std::size_t few = 16;
};

/// The Concentric Zone Model, section III-B: zones Z_m of rings and sectors, eqs. (2) and (3), as
/// tables.
class ConcentricZones {
 public:
  explicit ConcentricZones(const PatchworkConfig& config);

  /// Bins in all: N_C.
  [[nodiscard]] std::uint32_t bin_count() const noexcept { return bin_count_; }

  /// The bins of `count` points, each a bin, noise(), out_of_range() or invalid(). Takes any bit
  /// pattern.
  void locate(const float* x, const float* y, const float* z, std::size_t count,
              std::uint32_t* bins) const noexcept;

  /// What points have instead of a bin that belong to none.
  [[nodiscard]] std::uint32_t noise() const noexcept { return bin_count_; }
  [[nodiscard]] std::uint32_t out_of_range() const noexcept { return bin_count_ + 1; }
  [[nodiscard]] std::uint32_t invalid() const noexcept { return bin_count_ + 2; }

  /// Bins and these three.
  [[nodiscard]] std::uint32_t group_count() const noexcept { return bin_count_ + 3; }

  [[nodiscard]] const std::vector<Ring>& rings() const noexcept { return rings_; }

  /// L_min^2 and L_max^2.
  [[nodiscard]] float min_squared_range() const noexcept { return squared_radii_.front(); }
  /// L_min^2, or the least normal number.
  [[nodiscard]] float least_squared_range() const noexcept { return least_squared_range_; }
  [[nodiscard]] float max_squared_range() const noexcept { return squared_radii_.back(); }

  /// Do sectors begin elsewhere than at theta = -pi, or not go all around?
  [[nodiscard]] bool have_own_view() const noexcept { return begin_turn_ != 0 || turns_ != 1; }
  /// Where sector 0 begins, counted from theta = -pi, as a share of a full turn: 0 to below 1.
  [[nodiscard]] float begin_turn() const noexcept { return begin_turn_; }
  /// What of the full turn the zones cover, above 0, up to 1.
  [[nodiscard]] float turns() const noexcept { return turns_; }

  [[nodiscard]] const RingTree& tree() const noexcept { return tree_; }

  /// @name Tables by ring
  /// An entry for each leaf of the tree.
  /// @{
  [[nodiscard]] const float* sectors() const noexcept { return sectors_.data(); }
  /// The bits of integers.
  [[nodiscard]] const float* first_bins() const noexcept { return first_bins_.data(); }
  /// Lower points are noise, metres.
  [[nodiscard]] const float* noise_heights() const noexcept { return noise_heights_.data(); }
  /// @}

 private:
  void add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring);
  void grow_tree();

  std::vector<Ring> rings_;
  std::vector<float> squared_radii_;  ///< L_min^2 and each ring's outer radius squared, m^2
  float least_squared_range_ = 0;
  float begin_turn_ = 0;
  float turns_ = 1;
  std::vector<float> sectors_;
  std::vector<float> first_bins_;
  std::vector<float> noise_heights_;
  RingTree tree_;
  std::uint32_t bin_count_ = 0;
};

/// Reads chunk `chunk` of the cloud into `scan`, which is reserved for it, each point in its bin of
/// the Concentric Zone Model, noise(), out_of_range() or invalid(). Chunks may be read by several
/// threads at once.
void read_chunk(CloudView cloud, std::size_t chunk, const ConcentricZones& zones,
                plane_fits::ScanPoints& scan) noexcept;

}  // namespace flagstone::patchwork

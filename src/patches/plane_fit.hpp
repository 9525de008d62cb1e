// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plane.hpp"
#include "flagstone/patchwork_config.hpp"
#include "patches/bin_batch.hpp"
#include "patches/ground_sets.hpp"
#include "patches/seed_heights.hpp"
#include "patches/stage_clock.hpp"

namespace flagstone::patches {

/// Region-wise Ground Plane Fitting, section III-C, eqs. (3) to (6), for a batch of bins at a time.
class PlaneFit {
 public:
  explicit PlaneFit(const PatchworkConfig& config);

  /// Makes room for bins of `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) { seed_heights_.reserve(points); }

  /// The outcome for the bins of a batch.
  struct Result {
    /// Bins that have a plane: at no step were fewer than three points left.
    BinMask exists = 0;
    /// The final ground sets, eq. (6) of the last plane.
    GroundSets sets{};
    /// What the likelihood is to judge, seen from `origins`.
    PlaneBatch judged{};
    std::array<Vector3, batch_size> origins{};
  };

  /// Fits the planes of the bins. `zones[i]` is the zone m - 1 of bin i. Changes the batch: heights
  /// are seen from `origins` afterwards.
  void fit(BinBatch& batch, const std::array<std::uint16_t, batch_size>& zones, StageClock& clock,
           Result& result) noexcept;

 private:
  [[nodiscard]] BinMask fit_sets(const BinBatch& batch, const GroundSets& sets, BinMask wanted,
                                 StageClock& clock, PlaneBatch& planes) noexcept;
  void choose_next_sets(const PlaneBatch& planes, GroundSets& sets) const noexcept;

  std::vector<double> seed_cuts_;  // M_h * h_s of each zone, metres
  double seed_height_;             // z_seed
  double distance_margin_;         // M_d
  double noise_margin_;
  int iterations_;
  bool keep_below_margin_;
  bool judge_final_set_;
  SeedHeights seed_heights_;
  MomentsBatch moments_{};
};

}  // namespace flagstone::patches

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "library/core/plane.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/ground_sets.hpp"
#include "library/plane_fits/seed_heights.hpp"
#include "library/plane_fits/stage_clock.hpp"

namespace flagstone::plane_fits {

/// What is the same for all bins that are fitted.
struct FitSettings {
  double seed_height;  ///< z_seed: how far above the seeds' mean the first set reaches, metres
  /// How far below it, metres.
  double seed_depth = std::numeric_limits<double>::infinity();
  double distance_margin;   ///< M_d: later sets reach so far above the plane before, metres
  double noise_margin;      ///< and so far below it, metres
  int iterations;           ///< planes fitted one after another, at least 1
  bool keep_below_floor;    ///< may the first set hold points lower than any seed may be?
  bool evaluate_final_set;  ///< fit once more, to the set that the last plane chooses?
  /// z-bar_init of bins without any seed, metres: the sensor's own height, as in the public code.
  double height_without_seeds = 0;
};

/// The seeds of the bins of a batch.
struct Seeds {
  Batch floors;                                    ///< no seed lies below, metres
  std::array<std::uint32_t, batch_size> counts{};  ///< N_seed: the lowest so many, at least 1
};

/// Region-wise Ground Plane Fitting, section III-C, eqs. (4) to (6), for a batch of bins at a time.
class PlaneFit {
 public:
  explicit PlaneFit(const FitSettings& settings) noexcept : settings_(settings) {}

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

    /// Does bin `i` have a plane?
    [[nodiscard]] bool has_plane(std::size_t i) const noexcept { return (exists >> i & 1U) != 0; }
    /// Its plane in the sensor frame.
    [[nodiscard]] Plane plane(std::size_t i) const noexcept {
      return judged[i].moved_by(origins[i]);
    }
  };

  /// Fits the planes of the bins. Changes the batch: heights are seen from `origins` afterwards.
  void fit(BinBatch& batch, const Seeds& seeds, StageClock& clock, Result& result) noexcept;

 private:
  [[nodiscard]] BinMask fit_sets(const BinBatch& batch, const GroundSets& sets, BinMask wanted,
                                 StageClock& clock, PlaneBatch& planes) noexcept;
  void choose_next_sets(const PlaneBatch& planes, GroundSets& sets) const noexcept;

  FitSettings settings_;
  SeedHeights seed_heights_;
  MomentsBatch moments_{};
};

}  // namespace flagstone::plane_fits

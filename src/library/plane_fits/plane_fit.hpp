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

/// Settings of the fit, common to all bins.
struct FitSettings {
  double seed_height;  ///< z_seed: top of the first set above the mean of the seeds, metres
  /// Bottom of the first set below the mean of the seeds, metres.
  double seed_depth = std::numeric_limits<double>::infinity();
  double distance_margin;  ///< M_d: top of later sets above the previous plane, metres
  double noise_margin;     ///< bottom of later sets below the previous plane, metres
  int iterations;          ///< number of planes fitted in sequence, at least 1
  bool keep_below_floor;  ///< whether the first set can contain points below the floor of the seeds
  bool evaluate_final_set;  ///< whether to fit once more, to the set of the last plane
  /// Whether the points lie on the grid of ExactGrid, relative to the origin of their bin. The
  /// planes then do not depend on the order of the points.
  bool exact = false;
  /// z-bar_init of bins without seeds, metres: the height of the sensor itself, as in the authors'
  /// public code.
  double height_without_seeds = 0;
};

/// The seeds of the bins of a batch.
struct Seeds {
  Batch floors;                                    ///< minimum height of a seed, metres
  std::array<std::uint32_t, batch_size> counts{};  ///< N_seed: maximum number of seeds, at least 1
};

/// Region-wise Ground Plane Fitting, section III-C, eqs. (4) to (6), for one batch of bins at a
/// time.
class PlaneFit {
 public:
  explicit PlaneFit(const FitSettings& settings) noexcept : settings_(settings) {}

  /// Reserves memory for bins with up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) { seed_heights_.reserve(points); }

  /// The results for the bins of a batch.
  struct Result {
    /// Bins with a plane: all their sets had at least three points.
    BinMask exists = 0;
    /// The final ground sets: eq. (6) with the last plane.
    GroundSets sets{};
    /// The planes that the likelihood evaluates, relative to `origins`.
    PlaneBatch judged{};
    std::array<Vector3, batch_size> origins{};

    /// True if bin `i` has a plane.
    [[nodiscard]] bool has_plane(std::size_t i) const noexcept { return (exists >> i & 1U) != 0; }
    /// The plane of bin `i` in the sensor frame.
    [[nodiscard]] Plane plane(std::size_t i) const noexcept {
      return judged[i].moved_by(origins[i]);
    }
  };

  /// Fits the planes of the bins. Changes the batch: heights are relative to `origins` afterwards.
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/buffer.hpp"
#include "core/moments.hpp"
#include "flagstone/patchwork_config.hpp"
#include "patchwork/packed_points.hpp"

namespace flagstone::patchwork {

/// A plane n . p + d = 0 and the set of points it was fitted to, eq. (3).
struct Plane {
  double count = 0;       ///< points in the set; a plane needs three
  Vector3 mean{};         ///< p-bar, metres
  Vector3 normal{};       ///< n = v_3, unit length, z >= 0
  double d = 0;           ///< -n . p-bar, metres
  Vector3 eigenvalues{};  ///< lambda_1 >= lambda_2 >= lambda_3, m^2

  [[nodiscard]] bool exists() const noexcept { return count >= 3; }
};

/// Region-wise Ground Plane Fitting, section III-C, eqs. (3) to (6), for one bin at a time.
class PlaneFit {
 public:
  explicit PlaneFit(const PatchworkConfig& config) noexcept;

  /// Makes room for bins of `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) { heights_.reserve(points); }

  /// The outcome for one bin.
  struct Result {
    Plane last;  ///< of the last iteration: points less than M_d above it are the final ground set
    Plane judged;  ///< of the set that the likelihood is to judge
  };

  /// Fits the plane of a bin S_n. `seed_cut` is M_h * h_s of its zone, metres. If at any step fewer
  /// than three points are left, neither plane of the result exists.
  [[nodiscard]] Result fit(const PackedPoints& points, double seed_cut) noexcept;

 private:
  [[nodiscard]] double mean_seed_height(const PackedPoints& points, double seed_cut) noexcept;

  int seed_count_;          // N_seed
  double seed_height_;      // z_seed
  double distance_margin_;  // M_d
  double noise_margin_;
  int iterations_;
  bool keep_below_margin_;
  bool judge_final_set_;
  Buffer<float> heights_;  // z of a bin, to be partly sorted
};

}  // namespace flagstone::patchwork

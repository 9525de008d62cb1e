// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of Gpf. The initial values are from the comparison by Patchwork's authors
/// (url-kaist/Ground-Segmentation-Benchmark). Only Th_seeds differs from GPF's own paper.
struct GpfConfig {
  /// h_s: height of the sensor above the ground, metres, above 0, up to 100.
  float sensor_height = 1.73f;

  /// Points lower than -noise_factor * h_s are noise and are removed first. No unit, 1 to 1,000, or
  /// infinity for no such limit, which leaves algorithm 1 alone. 1.5 is the value of the public
  /// implementation.
  float noise_factor = 1.5f;

  /// N_segs: number of segments of the scan along x, 1 to 1,000.
  int segments = 3;

  /// Length of a segment along x, metres, above 0, up to 1,000; the paper does not give one. The
  /// segments are centred on the sensor. The first and the last extend to the end of the scan:
  /// three segments of 40 m meet at x = -20 m and x = 20 m.
  float segment_length = 40;

  /// N_LPR: number of lowest points whose mean height is the lowest point representative, 1 to
  /// 1,000,000.
  int lowest_points = 20;

  /// Th_seeds: points lower than the lowest point representative plus this are the seeds; metres,
  /// above 0, up to 100. GPF's own paper has 0.4, which more often leaves too few seeds if the
  /// street slopes down or has a ditch next to it.
  float seed_height = 0.6f;

  /// N_iter: number of plane fits per segment, 1 to 100.
  int iterations = 3;

  /// Th_dist: points less than this above the plane are ground; metres, above 0, up to 100.
  float distance_margin = 0.2f;

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;
};

/// Ground Plane Fitting: fits a plane to each segment of the scan along x, starting from the lowest
/// points of the segment. Not thread-safe: use one instance per thread.
///
/// D. Zermas, I. Izzat, N. Papanikolopoulos, "Fast Segmentation of 3D Point Clouds: A Paradigm on
/// LiDAR Data for Autonomous Vehicle Applications", ICRA 2017, algorithm 1.
///
/// First, points far below the ground are removed, as in the public implementation that Patchwork
/// was compared with (VincentCheungM/Run_based_segmentation). Algorithm 1 has no such step; it
/// relies on the mean of the N_LPR lowest points to outweigh outliers. HDL-64E scans have dozens of
/// reflections below the street, which is too many: all seeds are then reflections.
///
/// Ground has no lower bound, neither in the seeds nor in the final set: algorithm 1 compares the
/// signed value of the plane equation, which is negative below the plane. All remaining points
/// below the plane of a segment are ground. A segment with fewer than three seeds, or later fewer
/// than three ground points, has no plane and all its points are `nonground`.
class Gpf final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  explicit Gpf(GpfConfig config = {});
  ~Gpf() override;
  Gpf(Gpf&&) noexcept;
  Gpf& operator=(Gpf&&) noexcept;

  /// See Segmenter::segment. result.patches() contains the segments with points, rearmost first,
  /// numbered by Patch::sector, with the status `ground` or `no_plane`. The terms of the likelihood
  /// are zero.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration passed to the constructor.
  [[nodiscard]] const GpfConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of Gpf. The initial values are those that Patchwork's authors compared it with
/// (url-kaist/Ground-Segmentation-Benchmark); they differ from GPF's own paper in Th_seeds alone.
struct GpfConfig {
  /// h_s: height of the sensor above the ground, metres, above 0, up to 100.
  float sensor_height = 1.73f;

  /// Points lower than -noise_factor * h_s are noise and taken out first. No unit, 1 to 1,000, or
  /// infinity for none: algorithm 1 and nothing else. 1.5 is the public implementation's.
  float noise_factor = 1.5f;

  /// N_segs: segments the scan is cut into along x, 1 to 1,000.
  int segments = 3;

  /// Length of a segment along x, metres, above 0, up to 1,000; the paper does not print one. The
  /// segments lie around the sensor, half of them on either side; the first and the last reach to
  /// the end of the scan. Three of 40 m meet at x = -20 m and x = 20 m.
  float segment_length = 40;

  /// N_LPR: the lowest points whose mean height is the lowest point representative, 1 to 1,000,000.
  int lowest_points = 20;

  /// Th_seeds: points lower than the lowest point representative plus this are the seeds; metres,
  /// above 0, up to 100. GPF's own paper has 0.4, with which a street that falls away, or a ditch
  /// beside it, more often leaves too few seeds.
  float seed_height = 0.6f;

  /// N_iter: plane fits a segment, 1 to 100.
  int iterations = 3;

  /// Th_dist: points less than this above the plane are ground; metres, above 0, up to 100.
  float distance_margin = 0.2f;

  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  void check() const;
};

/// Ground Plane Fitting: a plane for each segment along the direction of travel, started from its
/// lowest points.
///
/// D. Zermas, I. Izzat, N. Papanikolopoulos, "Fast Segmentation of 3D Point Clouds: A Paradigm on
/// LiDAR Data for Autonomous Vehicle Applications", ICRA 2017, algorithm 1.
///
/// Before it, points far below the sensor's foot are taken out, as the public implementation does
/// that Patchwork was compared with (VincentCheungM/Run_based_segmentation). Algorithm 1 has no
/// such step and relies on the mean of the N_LPR lowest points to outweigh erroneous ones. Dozens
/// of reflections below the street, as HDL-64E scans have, are too many for it: no seeds are left
/// but reflections.
///
/// Ground has no lower bound, in the seeds as in the final set: algorithm 1 compares the value of
/// the plane's equation, which is negative below. What lies below a segment's plane is ground
/// unless it was taken out. Where fewer than three points are seeds, or later ground, the segment
/// has no plane and all of it is nonground.
class Gpf final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit Gpf(GpfConfig config = {});
  ~Gpf() override;
  Gpf(Gpf&&) noexcept;
  Gpf& operator=(Gpf&&) noexcept;

  /// See Segmenter::segment. result.patches() holds the segments that have points, rearmost first,
  /// numbered by Patch::sector; verdict ground, or no_plane. Nothing judges the planes: the terms
  /// of the likelihood stay zero.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const GpfConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of LineFit. Except for the sensor height, the initial values are from the
/// implementation that the Patchwork paper compares with (lorenwel/linefit_ground_segmentation).
/// Two settings that it lacks are marked.
struct LineFitConfig {
  /// Height of the sensor above the ground, metres, -100 to 100.
  float sensor_height = 1.73f;

  // The polar grid: S segments of B bins
  // ----------------------------------------------------

  /// Points nearer than this are out of range, metres, 0 to 1,000.
  float min_range = 0.5f;
  /// Points at this range or farther are out of range, metres, above min_range, up to 1,000.
  float max_range = 50.0f;
  /// S = 2 pi / delta alpha: number of segments, 1 to 3,600. All segments together have at most
  /// 65,535 bins.
  int segments = 360;
  /// B: number of bins per segment, all of the same width, 3 to 1,000.
  int bins = 120;

  // The lines of a segment, algorithm 1
  // ----------------------------------------------------

  /// T_m: maximum slope of a line, m/m, 0 to 10.
  float max_slope = 0.3f;
  /// T_m_small: lines with a smaller slope are nearly flat and must satisfy max_intercept; m/m, 0
  /// to
  /// 10. The value 0.02 is ours; the implementation does not compare intercepts.
  float flat_slope = 0.02f;
  /// T_b: maximum distance between a nearly flat line, extended to the sensor, and the ground below
  /// the sensor. Prevents plateaus from being ground. Metres, above 0, up to 1,000, or infinity for
  /// no limit. The value 0.5 is ours; the implementation does not compare intercepts.
  float max_intercept = 0.5f;
  /// T_RMSE: maximum error of a line. As in the implementation, this limits the largest vertical
  /// residual, which is stricter than the RMS error; metres, above 0, up to 100.
  float max_fit_error = 0.05f;
  /// T_dprev: maximum height difference between the start of a line and the end of the previous
  /// line, or the ground below the sensor for the first line; metres, above 0, up to 100.
  float max_start_height = 0.2f;
  /// Gaps between consecutive points longer than this are long: a line does not begin with a long
  /// gap, and does not cross one before it has three points; metres, above 0, up to 1,000.
  float long_gap = 1.0f;
  /// Maximum height of the first point after a long gap above or below the line so far; metres,
  /// above 0, up to 100.
  float max_gap_height = 0.1f;

  // Which points are ground
  // ----------------------------------------------------

  /// T_dground: points nearer to their line than this, measured vertically, are ground; metres,
  /// above 0, up to 100.
  float max_distance = 0.05f;
  /// Maximum angle to either side within which a line is searched for if the segment of the point
  /// has none; degrees, 0 to 180. The default is 0.1 rad.
  float search_angle = 5.73f;

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;
};

/// LineFit: divides the scan into narrow segments around the sensor and fits straight lines to the
/// lowest points of their radial bins. Points near a line are ground. Not thread-safe: use one
/// instance per thread.
///
/// M. Himmelsbach, F. v. Hundelshausen, H.-J. Wuensche, "Fast Segmentation of 3D Point Clouds for
/// Ground Vehicles", IEEE Intelligent Vehicles Symposium, 2010. This is the ground segmentation of
/// the paper, with the rules for gaps from lorenwel/linefit_ground_segmentation.
class LineFit final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  explicit LineFit(LineFitConfig config = {});
  ~LineFit() override;
  LineFit(LineFit&&) noexcept;
  LineFit& operator=(LineFit&&) noexcept;

  /// See Segmenter::segment. result.patches() is empty.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration passed to the constructor.
  [[nodiscard]] const LineFitConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

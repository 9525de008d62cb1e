// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Every setting of LineFit. Initial values are those of the implementation that the Patchwork
/// paper compares with (lorenwel/linefit_ground_segmentation), but for the sensor's height; the two
/// that it lacks are marked.
struct LineFitConfig {
  /// Height of the sensor above the ground, metres, -100 to 100.
  float sensor_height = 1.73f;

  // The polar grid: S segments of B bins
  // ----------------------------------------------------

  /// Nearer points are out of range, metres, 0 to 1,000.
  float min_range = 0.5f;
  /// Points from here on are out of range, metres, above min_range, up to 1,000.
  float max_range = 50.0f;
  /// S = 2 pi / delta alpha, 1 to 3,600; at most 65,535 bins in all segments together.
  int segments = 360;
  /// B: bins of a segment, all of one width, 3 to 1,000.
  int bins = 120;

  // The lines of a segment, algorithm 1
  // ----------------------------------------------------

  /// T_m: steepest line, metres a metre, 0 to 10.
  float max_slope = 0.3f;
  /// T_m_small: a line less steep than this is nearly flat and judged by max_intercept, metres a
  /// metre, 0 to 10. 0.02 is ours; the implementation compares no intercepts.
  float flat_slope = 0.02f;
  /// T_b: how far from the ground below the sensor a nearly flat line may pass, extended to there,
  /// so that no plateau is ground; metres, above 0, up to 1,000, or infinity for no limit. 0.5 is
  /// ours, as above.
  float max_intercept = 0.5f;
  /// T_RMSE: how well a line must fit. As in the implementation the largest vertical residual is
  /// compared, which is stricter than the root of the mean square; metres, above 0, up to 100.
  float max_fit_error = 0.05f;
  /// T_dprev: how far a line may begin above or below the end of the one before it, the first line
  /// from the ground below the sensor; metres, above 0, up to 100.
  float max_start_height = 0.2f;
  /// A line neither begins with a longer gap between its points nor crosses one before it has
  /// three; metres, above 0, up to 1,000.
  float long_gap = 1.0f;
  /// From such a gap on, how far the next point may lie above or below the line so far; metres,
  /// above 0, up to 100.
  float max_gap_height = 0.1f;

  // Which points are ground
  // ----------------------------------------------------

  /// T_dground: a point nearer to its line is ground, along the vertical; metres, above 0, up to
  /// 100.
  float max_distance = 0.05f;
  /// How far to either side a line is looked for where the own segment has none; degrees, 0 to
  /// 180. 0.1 rad.
  float search_angle = 5.73f;

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;
};

/// LineFit: ground as straight lines through the lowest points of the radial bins of narrow
/// segments around the sensor.
///
/// M. Himmelsbach, F. v. Hundelshausen, H.-J. Wuensche, "Fast Segmentation of 3D Point Clouds for
/// Ground Vehicles", IEEE Intelligent Vehicles Symposium, 2010; its ground segmentation, with the
/// rules about gaps of the implementation named above.
class LineFit final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit LineFit(LineFitConfig config = {});
  ~LineFit() override;
  LineFit(LineFit&&) noexcept;
  LineFit& operator=(LineFit&&) noexcept;

  /// See Segmenter::segment. There are no patches.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The configuration it was made with.
  [[nodiscard]] const LineFitConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

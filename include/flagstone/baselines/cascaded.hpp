// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Every setting of Cascaded. Initial values are those that the authors' implementation
/// (n-patiphon/cascaded_ground_seg) is launched with, for a Velodyne HDL-64E, but for the sensor's
/// height; those that it lacks are marked.
struct CascadedConfig {
  /// Height of the sensor above the ground, metres, above 0, up to 100: without it rings have no
  /// distances.
  float sensor_height = 1.73f;

  /// Points from here on are out of range, metres, above 0, up to 1,000. Ours: the reach of the
  /// HDL-64E.
  float max_range = 120.0f;

  /// Angle of each beam above the horizontal, the lowest beam first: ring 0; ascending, degrees,
  /// -89 to 89. From 2 to 1,000 beams.
  std::vector<float> beam_elevations = hdl_64e_elevations();

  // First stage: the inter-ring filter
  // --------------------------------------------------------------------

  /// Columns of the range image: directions in which points count as one above the other, 1 to
  /// 3,600. About the number of firings a turn.
  int columns = 2083;

  /// Steepest rise of the ground from below the sensor: rings that are closer together than on such
  /// a slope have met something upright. Degrees, 0 to 45; 0 expects flat ground.
  float max_slope = 5.0f;

  /// What rings met that are too close together is upright if it is higher than this; metres, 0 to
  /// 100.
  float min_object_height = 0.08f;

  // Second stage: planes of regions, from the sensor outward in four directions
  // ---------------------------------------------------------------------------

  /// Regions of each direction, 1 to 100; each is as wide as an equal share of the rings would be
  /// on flat ground.
  int sections = 4;

  /// Points at most this far from the plane of their region, above or below, are ground; metres,
  /// above 0, up to 100.
  float max_distance = 0.35f;

  /// Samples of three points that are drawn for a plane at most, 1 to 1,000,000.
  int max_trials = 50;

  /// How far a plane may lean against that of the region before it, the first against the
  /// horizontal; degrees, 0 to 90. A plane that leans more is replaced by the one before.
  float max_angle_change = 16.0f;

  /// How far a plane may lie above or below that of the region before it where the two meet, the
  /// first from the ground below the sensor; metres, above 0, up to 100. 0.5 is ours: the
  /// implementation has such a setting, of 5, which nothing reads.
  float max_height_change = 0.5f;

  /// Start of the random numbers, 0 to 1,000,000,000. Ours.
  int seed = 0;

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;

  /// The 64 beams of the Velodyne HDL-64E, from -24.33 to 2 degrees, after its manual.
  static std::vector<float> hdl_64e_elevations();
};

/// CascadedSeg: upright things are taken out where consecutive rings fall together closer than on
/// any slope; planes are then fitted to what is left, region by region outward, each continuous
/// with the one before.
///
/// P. Narksri, E. Takeuchi, Y. Ninomiya, Y. Morales, N. Akai, N. Kawaguchi, "A Slope-robust
/// Cascaded Ground Segmentation in 3D Point Cloud for Autonomous Vehicles", IEEE ITSC, 2018.
///
/// The order of the input decides which points a seed draws.
class Cascaded final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the range allowed.
  explicit Cascaded(CascadedConfig config = {});
  ~Cascaded() override;
  Cascaded(Cascaded&&) noexcept;
  Cascaded& operator=(Cascaded&&) noexcept;

  /// See Segmenter::segment. A point's ring is that of the beam whose elevation is nearest to its
  /// own. result.patches() holds the regions: `ring` counts sections outward, `sector` is 0
  /// backward, 1 right, 2 forward, 3 left.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// The same with each point's ring as the sensor gives it: rings[i], 0 the lowest beam, is that
  /// of cloud[i]. Fails with `invalid_argument` if there is not one for each point, or one without
  /// an elevation in the configuration.
  Status segment(CloudView cloud, std::span<const std::uint16_t> rings,
                 Segmentation& result) noexcept;

  /// The configuration it was made with.
  [[nodiscard]] const CascadedConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "flagstone/segmenter.hpp"

namespace flagstone {

/// Settings of Cascaded. Except for the sensor height, the initial values are the launch parameters
/// of the authors' implementation (n-patiphon/cascaded_ground_seg) for a Velodyne HDL-64E. Settings
/// that it lacks are marked.
struct CascadedConfig {
  /// Height of the sensor above the ground, metres, above 0, up to 100. It determines the distances
  /// between rings on flat ground.
  float sensor_height = 1.73f;

  /// Points at this range or farther are out of range, metres, above 0, up to 1,000. This setting
  /// is ours; the value is the maximum range of the HDL-64E.
  float max_range = 120.0f;

  /// Elevation of each beam above the horizontal, degrees, -89 to 89, ascending; the lowest beam is
  /// ring 0. 2 to 1,000 beams.
  std::vector<float> beam_elevations = hdl_64e_elevations();

  // First stage: the inter-ring filter
  // --------------------------------------------------------------------

  /// Number of columns of the range image, 1 to 3,600; about the number of firings per turn. Points
  /// in the same column are treated as one above the other.
  int columns = 2083;

  /// Maximum slope of the ground as seen from below the sensor, degrees, 0 to 45; 0 for flat
  /// ground. Rings that are closer together than on such a slope are on an upright object.
  float max_slope = 5.0f;

  /// Minimum height of such an upright object; metres, 0 to 100.
  float min_object_height = 0.08f;

  // Second stage: planes of regions, from the sensor outward in four directions
  // ---------------------------------------------------------------------------

  /// Number of regions in each direction, 1 to 100. On flat ground, every region would contain the
  /// same number of rings.
  int sections = 4;

  /// Points at most this far above or below the plane of their region are ground; metres, above 0,
  /// up to 100.
  float max_distance = 0.35f;

  /// Maximum number of samples of three points per plane, 1 to 1,000,000.
  int max_trials = 50;

  /// Maximum angle between a plane and the plane of the previous region, or the horizontal for the
  /// first region; degrees, 0 to 90. A plane with a larger angle is replaced by the previous plane.
  float max_angle_change = 16.0f;

  /// Maximum height difference between a plane and the plane of the previous region where the two
  /// meet, or the ground below the sensor for the first region; metres, above 0, up to 100. The
  /// value 0.5 is ours: the implementation has such a setting, with value 5, but does not use it.
  float max_height_change = 0.5f;

  /// Seed of the random numbers, 0 to 1,000,000,000. This setting is ours.
  int seed = 0;

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;

  /// Elevations of the 64 beams of the Velodyne HDL-64E, -24.33 to 2 degrees, from its manual.
  static std::vector<float> hdl_64e_elevations();
};

/// CascadedSeg: removes upright objects, where consecutive rings are closer together than on any
/// slope. It then fits planes to the remaining points, region by region from the sensor outwards,
/// each continuous with the previous one. Not thread-safe: use one instance per thread.
///
/// P. Narksri, E. Takeuchi, Y. Ninomiya, Y. Morales, N. Akai, N. Kawaguchi, "A Slope-robust
/// Cascaded Ground Segmentation in 3D Point Cloud for Autonomous Vehicles", IEEE ITSC, 2018.
///
/// The samples depend on the seed and on the order of the input.
class Cascaded final : public Segmenter {
 public:
  /// Throws std::invalid_argument naming the field, its value and the allowed range.
  explicit Cascaded(CascadedConfig config = {});
  ~Cascaded() override;
  Cascaded(Cascaded&&) noexcept;
  Cascaded& operator=(Cascaded&&) noexcept;

  /// See Segmenter::segment. Each point belongs to the ring of the beam with the nearest elevation.
  /// result.patches() contains the regions: `ring` is the number of the section, counted outwards;
  /// `sector` is 0 backward, 1 right, 2 forward, 3 left.
  Status segment(CloudView cloud, Segmentation& result) noexcept override;

  /// Overload with the ring of each point as reported by the sensor: rings[i] is the ring of
  /// cloud[i]; 0 is the lowest beam. Fails with `invalid_argument` if the number of rings differs
  /// from the number of points, or a ring has no elevation in the configuration.
  Status segment(CloudView cloud, std::span<const std::uint16_t> rings,
                 Segmentation& result) noexcept;

  /// The configuration passed to the constructor.
  [[nodiscard]] const CascadedConfig& config() const noexcept;

 private:
  struct Pipeline;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace flagstone

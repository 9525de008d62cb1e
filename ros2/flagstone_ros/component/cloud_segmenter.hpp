// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/ros/derived_cloud.hpp"
#include "files/ros/point_cloud2.hpp"
#include "flagstone/gravity_aligned_segmenter.hpp"
#include "monitor.hpp"
#include "segmenter_settings.hpp"
#include "transform.hpp"

namespace flagstone_ros {

/// An output of the node; see the topics of the declaration.
enum class Output : std::uint8_t { ground, nonground, labelled };

/// A segmenter with its buffers: from a cloud to the outputs. Keeps its memory from cloud to cloud.
/// Not thread-safe.
class CloudSegmenter {
 public:
  /// Throws what SegmenterSettings::make throws.
  explicit CloudSegmenter(const SegmenterSettings& settings);

  /// Labels the points of `cloud`, which must satisfy check(). They are transformed with
  /// `to_sensor` first; `up`, if any, is the up direction in the frame of the sensor. Both only
  /// affect the segmentation: the outputs contain the original points.
  ///
  /// bad_file if x, y or z is missing or has an unknown type; out_of_memory.
  flagstone::Status segment(const flagstone::ros::PointCloud2View& cloud,
                            const Transform& to_sensor, const std::optional<Vector>& up);

  /// Plans an output for the cloud that was segmented last, with all its fields. `cloud` and this
  /// object must not change while `derived` is used. Errors as DerivedCloud::append().
  flagstone::Status plan(Output output, const flagstone::ros::PointCloud2View& cloud,
                         flagstone::ros::DerivedCloud& derived) const;

  /// Labels and heights of the last cloud.
  [[nodiscard]] const flagstone::Segmentation& result() const noexcept { return result_; }

  /// Facts about the last cloud; the latency is not set.
  [[nodiscard]] CloudSummary summary() const;

  /// One line, once per object: most points of the last cloud are out of range.
  [[nodiscard]] std::optional<std::string> warning();

 private:
  SegmenterSettings settings_;
  std::unique_ptr<flagstone::GravityAlignedSegmenter> segmenter_;
  flagstone::Segmentation result_;
  std::vector<float> converted_;
  std::vector<float> transformed_;
  Vector up_ = {0, 0, 1};
  bool has_warned_ = false;
};

}  // namespace flagstone_ros

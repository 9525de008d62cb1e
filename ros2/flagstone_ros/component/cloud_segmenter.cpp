// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cloud_segmenter.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <new>
#include <numbers>

#include "declaration.hpp"
#include "files/ros/coordinates.hpp"

namespace flagstone_ros {

using flagstone::Label;
using flagstone::Status;

CloudSegmenter::CloudSegmenter(const SegmenterSettings& settings)
    : settings_(settings), segmenter_(settings.make()) {}

Status CloudSegmenter::segment(const flagstone::ros::PointCloud2View& cloud,
                               const Transform& to_sensor, const std::optional<Vector>& up) {
  flagstone::CloudView points;
  if (Status status = view_coordinates(cloud, converted_, points); !status.ok()) return status;
  const Transform to_level = up ? levelling(*up) * to_sensor : to_sensor;
  if (to_level != Transform()) {
    try {
      transform_points(to_level, settings_.scale(), points, transformed_);
    } catch (const std::bad_alloc&) {
      return Status(flagstone::StatusCode::out_of_memory);
    }
    points = flagstone::CloudView(transformed_.data(), points.size());
  }
  Status status = segmenter_->segment(points, result_);
  const std::array<float, 3>& estimated = segmenter_->mount().up;
  up_ = up.value_or(Vector{estimated[0], estimated[1], estimated[2]});
  return status;
}

Status CloudSegmenter::plan(Output output, const flagstone::ros::PointCloud2View& cloud,
                            flagstone::ros::DerivedCloud& derived) const {
  using flagstone::ros::Selection;
  switch (output) {
    case Output::ground: return derived.select(cloud, Selection(result_.labels(), {Label::ground}));
    case Output::nonground:
      return derived.select(cloud, Selection(result_.labels(), {Label::nonground}));
    case Output::labelled: break;
  }
  const std::array added = {flagstone::ros::label_field(result_.labels()),
                            flagstone::ros::height_field(result_.heights())};
  return derived.append(cloud, added);
}

CloudSummary CloudSegmenter::summary() const {
  CloudSummary summary;
  const std::size_t finite = result_.labels().size() - result_.count(Label::invalid);
  if (finite > 0) {
    summary.out_of_range =
        static_cast<double>(result_.count(Label::out_of_range)) / static_cast<double>(finite);
  }
  summary.sensor_height = static_cast<double>(segmenter_->mount().sensor_height);
  summary.tilt = std::atan2(std::hypot(up_[0], up_[1]), up_[2]) * 180 / std::numbers::pi;
  summary.mount = to_sentence(segmenter_->decision());
  return summary;
}

std::optional<std::string> CloudSegmenter::warning() {
  constexpr std::size_t min_points = 1000;  // all points of a small cloud may be far away
  const std::size_t points = result_.labels().size();
  const std::size_t out = result_.count(Label::out_of_range);
  const std::size_t finite = points - result_.count(Label::invalid);
  const bool is_most = static_cast<double>(out) > mostly_out_of_range * static_cast<double>(finite);
  if (has_warned_ || finite < min_points || !is_most) return std::nullopt;
  has_warned_ = true;
  return fmt::format(
      "points: {} of {} points are out of range (expected metres, origin at the sensor; for "
      "millimetres set mount.scale to 0.001)",
      out, points);
}

}  // namespace flagstone_ros

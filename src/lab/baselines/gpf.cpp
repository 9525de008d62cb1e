// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/gpf.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lab/baselines/coordinates.hpp"
#include "lab/baselines/fitted_plane.hpp"
#include "lab/baselines/gpf_segments.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/buffer.hpp"
#include "library/core/segment_scan.hpp"

namespace flagstone {
std::vector<Setting> settings_of(GpfConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "h_s: height of the sensor above the ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"noise_factor",
       &c.noise_factor,
       "points lower than -noise_factor * h_s are noise",
       {.low = 1, .high = 1000, .allow_infinity = true}},
      {"segments", &c.segments, "N_segs: number of segments along x", {.low = 1, .high = 1000}},
      {"segment_length",
       &c.segment_length,
       "length of a segment along x (the first and the last segment are open-ended)",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"lowest_points",
       &c.lowest_points,
       "N_LPR: number of lowest points whose mean height is the lowest point representative",
       {.low = 1, .high = 1000000}},
      {"seed_height",
       &c.seed_height,
       "Th_seeds: points less than this above the lowest point representative are seeds",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"iterations",
       &c.iterations,
       "N_iter: number of plane fits per segment",
       {.low = 1, .high = 100}},
      {"distance_margin",
       &c.distance_margin,
       "Th_dist: points less than this above the plane are ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
  };
}

void GpfConfig::check() const {
  GpfConfig copy = *this;  // settings refer to members that are not const
  check_settings("gpf", settings_of(copy));
}

using baselines::Coordinates;
using baselines::fit_plane;
using baselines::set_ground_plane;
using baselines::single_precision;
using baselines::SinglePrecisionPlane;

namespace {

GpfConfig checked(const GpfConfig& config) {
  config.check();
  return config;
}

}  // namespace

/// Removes reflections, then runs algorithm 1 for each segment.
struct Gpf::Pipeline {
  explicit Pipeline(const GpfConfig& settings)
      : config(checked(settings)), segments(config.segments, config.segment_length) {}

  void reserve(std::size_t point_count, Segmentation& result) {
    points.reserve(point_count);
    segments.reserve(point_count);
    heights.reserve(point_count);
    result.mutable_patches().reserve(static_cast<std::size_t>(config.segments));
  }

  void segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    points.gather(cloud, labels);
    points.remove_below(-config.noise_factor * config.sensor_height, Label::noise, labels);
    segments.sort(points);
    for (int s = 0; s < segments.count(); ++s) {
      const Coordinates in_segment = segments.points(s);
      if (in_segment.size() == 0) continue;
      Patch patch{.sector = static_cast<std::uint16_t>(s), .verdict = Verdict::no_plane};
      patch.point_count = static_cast<std::uint32_t>(in_segment.size());
      const Plane fit = fit_ground(in_segment);
      if (fit.exists()) {
        set_ground_plane(fit, patch);
        label_ground(in_segment, segments.index(s), single_precision(fit), patch, labels);
      }
      result.mutable_patches().push_back(patch);  // within the reserved capacity
    }
  }

  /// Predicate: whether a point is ground for `plane`, algorithm 1.
  [[nodiscard]] auto ground_of(const SinglePrecisionPlane& plane) const noexcept {
    return [plane, margin = config.distance_margin](float x, float y, float z) {
      return plane.distance(x, y, z) < margin;
    };
  }

  /// Fits a plane to the seeds, then N_iter - 1 times to the points on or below the previous plane.
  [[nodiscard]] Plane fit_ground(const Coordinates& in_segment) noexcept {
    const double seed_limit = lowest_point_representative(in_segment.z) + config.seed_height;
    Plane fit = fit_plane(in_segment, [=](float, float, float z) { return z < seed_limit; });
    for (int i = 1; i < config.iterations && fit.exists(); ++i) {
      fit = fit_plane(in_segment, ground_of(single_precision(fit)));
    }
    return fit;
  }

  /// LPR: mean height of the N_LPR lowest points, or of all points if there are fewer.
  [[nodiscard]] double lowest_point_representative(std::span<const float> z) noexcept {
    float* begin = heights.data();
    float* end = std::ranges::copy(z, begin).out;
    const std::ptrdiff_t lowest = std::min<std::ptrdiff_t>(config.lowest_points, end - begin);
    std::nth_element(begin, begin + lowest - 1, end);
    std::ranges::sort(begin, begin + lowest);  // the sum must not depend on the order of the input
    double sum = 0;
    for (const float* height = begin; height < begin + lowest; ++height) sum += *height;
    return sum / static_cast<double>(lowest);
  }

  void label_ground(const Coordinates& in_segment, std::span<const std::uint32_t> index,
                    const SinglePrecisionPlane& plane, Patch& patch,
                    std::span<Label> labels) const noexcept {
    const auto is_ground = ground_of(plane);
    for (std::size_t i = 0; i < in_segment.size(); ++i) {
      if (!is_ground(in_segment.x[i], in_segment.y[i], in_segment.z[i])) continue;
      labels[index[i]] = Label::ground;
      ++patch.ground_count;
    }
  }

  GpfConfig config;
  baselines::UsablePoints points;
  baselines::GpfSegments segments;
  Buffer<float> heights;
};

Gpf::Gpf(GpfConfig config) : pipeline_(std::make_unique<Pipeline>(config)) {}
Gpf::~Gpf() = default;
Gpf::Gpf(Gpf&&) noexcept = default;
Gpf& Gpf::operator=(Gpf&&) noexcept = default;

const GpfConfig& Gpf::config() const noexcept { return pipeline_->config; }

Status Gpf::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    pipeline_->reserve(cloud.size(), result);
    pipeline_->segment(cloud, result, labels);
  });
}

Method baselines::gpf_method() { return baseline<GpfConfig, Gpf>("gpf", "GPF"); }

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/ransac.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lab/baselines/coordinates.hpp"
#include "lab/baselines/fitted_plane.hpp"
#include "lab/baselines/ransac_search.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/segment_scan.hpp"

namespace flagstone {
std::vector<Setting> settings_of(RansacConfig& c) {
  return {
      {"distance_threshold",
       &c.distance_threshold,
       "points at most this far from a plane are its inliers",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"confidence",
       &c.confidence,
       "z: required probability that at least one trial draws no outlier",
       {.low = 0, .high = 0.999999, .exclusive_min = true}},
      {"max_trials", &c.max_trials, "maximum number of trials", {.low = 1, .high = 1000000}},
      {"min_consensus",
       &c.min_consensus,
       "t: minimum number of inliers of a plane",
       {.low = 3, .high = 1000000}},
      {"seed", &c.seed, "seed of the random number generator", {.low = 0, .high = 1e9}},
  };
}

void RansacConfig::check() const {
  RansacConfig copy = *this;  // settings refer to members that are not const
  check_settings("ransac", settings_of(copy));
}

using baselines::Coordinates;
using baselines::fit_plane;
using baselines::set_ground_plane;
using baselines::single_precision;
using baselines::SinglePrecisionPlane;

/// Finds the plane with the most inliers and fits it to them.
struct Ransac::Pipeline {
  explicit Pipeline(const RansacConfig& settings) : config(settings) { config.check(); }

  void reserve(std::size_t point_count, Segmentation& result) {
    points.reserve(point_count);
    result.mutable_patches().reserve(1);
  }

  void segment(CloudView cloud, Segmentation& result, std::span<Label> labels) noexcept {
    points.gather(cloud, labels);
    if (points.size() == 0) return;
    Patch patch{.verdict = Verdict::no_plane};
    patch.point_count = static_cast<std::uint32_t>(points.size());
    const Plane fit = find_plane(points.coordinates());
    if (fit.exists()) {
      set_ground_plane(fit, patch);
      label_consensus(single_precision(fit), patch, labels);
    }
    result.mutable_patches().push_back(patch);  // within the reserved capacity
  }

  /// Predicate: whether a point belongs to the consensus set of `plane`.
  [[nodiscard]] auto agreeing_with(const SinglePrecisionPlane& plane) const noexcept {
    return [plane, limit = config.distance_threshold](float x, float y, float z) {
      return std::abs(plane.distance(x, y, z)) <= limit;
    };
  }

  /// Section II: fits a plane to the consensus set of the best sample, then fits again to the
  /// consensus set of that plane.
  [[nodiscard]] Plane find_plane(const Coordinates& all) const noexcept {
    const baselines::RansacSearch search = search_plane(all, config);
    if (search.consensus < static_cast<std::size_t>(config.min_consensus)) return {};
    const Plane first = fit_plane(all, agreeing_with(search.plane));
    if (!first.exists()) return {};
    return fit_plane(all, agreeing_with(single_precision(first)));
  }

  void label_consensus(const SinglePrecisionPlane& plane, Patch& patch,
                       std::span<Label> labels) const noexcept {
    const auto agrees = agreeing_with(plane);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!agrees(points.x()[i], points.y()[i], points.z()[i])) continue;
      labels[points.index()[i]] = Label::ground;
      ++patch.ground_count;
    }
  }

  RansacConfig config;
  baselines::UsablePoints points;
};

Ransac::Ransac(RansacConfig config) : pipeline_(std::make_unique<Pipeline>(config)) {}
Ransac::~Ransac() = default;
Ransac::Ransac(Ransac&&) noexcept = default;
Ransac& Ransac::operator=(Ransac&&) noexcept = default;

const RansacConfig& Ransac::config() const noexcept { return pipeline_->config; }

Status Ransac::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result, [&](std::span<Label> labels) {
    pipeline_->reserve(cloud.size(), result);
    pipeline_->segment(cloud, result, labels);
  });
}

Method baselines::ransac_method() { return baseline<RansacConfig, Ransac>("ransac", "RANSAC"); }

}  // namespace flagstone

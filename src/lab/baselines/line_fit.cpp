// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/line_fit.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "lab/baselines/line_fit_segments.hpp"
#include "lab/baselines/polar_grid.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/segment_scan.hpp"

namespace flagstone {

using baselines::GroundLines;
using baselines::LowestPoints;
using baselines::PolarGrid;
using baselines::UsablePoints;

struct LineFit::Pipeline {
  explicit Pipeline(const LineFitConfig& checked)
      : config(checked),
        grid(config.min_range, config.max_range, config.bins, config.segments),
        lowest(grid),
        lines(grid, config) {}

  void label(CloudView cloud, std::span<Label> labels) {
    points.reserve(cloud.size());
    grid.reserve(cloud.size());
    ranges.reserve(cloud.size());
    points.gather(cloud, labels);
    const std::span<const std::uint32_t> bins = grid.locate(points);
    measure_ranges();
    lowest.collect(points, ranges.data(), bins);
    lines.extract(lowest);
    for (std::size_t k = 0; k < points.size(); ++k) {
      labels[points.index()[k]] = label_of(bins[k], ranges.data()[k], points.z()[k]);
    }
  }

  void measure_ranges() noexcept {
    const float* x = points.x().data();
    const float* y = points.y().data();
    float* range = ranges.data();
    for (std::size_t k = 0; k < points.size(); ++k) range[k] = std::sqrt(x[k] * x[k] + y[k] * y[k]);
  }

  [[nodiscard]] Label label_of(std::uint32_t bin, float range, float height) const noexcept {
    if (bin >= grid.bin_count()) return Label::out_of_range;
    const float distance = lines.distance(bin % grid.sectors(), range, height);
    return distance < config.max_distance ? Label::ground : Label::nonground;
  }

  LineFitConfig config;
  UsablePoints points;
  PolarGrid grid;
  Buffer<float> ranges;
  LowestPoints lowest;
  GroundLines lines;
};

namespace {

LineFitConfig checked(const LineFitConfig& config) {
  config.check();
  return config;
}

}  // namespace

LineFit::LineFit(LineFitConfig config) : pipeline_(std::make_unique<Pipeline>(checked(config))) {}
LineFit::~LineFit() = default;
LineFit::LineFit(LineFit&&) noexcept = default;
LineFit& LineFit::operator=(LineFit&&) noexcept = default;

const LineFitConfig& LineFit::config() const noexcept { return pipeline_->config; }

Status LineFit::segment(CloudView cloud, Segmentation& result) noexcept {
  return segment_scan(cloud, result,
                      [&](std::span<Label> labels) { pipeline_->label(cloud, labels); });
}

Method baselines::line_fit_method() {
  return baseline<LineFitConfig, LineFit>("line_fit", "LineFit");
}

}  // namespace flagstone

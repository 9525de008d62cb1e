// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/line_fit.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "lab/baselines/line_fit_segments.hpp"
#include "lab/baselines/polar_grid.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/segment_scan.hpp"

namespace flagstone {
namespace {

constexpr std::string_view method = "line_fit";

constexpr ValidRange distance(double high, bool allow_infinity = false) {
  return {
      .low = 0, .high = high, .unit = "m", .exclusive_min = true, .allow_infinity = allow_infinity};
}

}  // namespace

std::vector<Setting> settings_of(LineFitConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "height of the sensor above the ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"min_range",
       &c.min_range,
       "points closer than this horizontal range are out of range",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"max_range", &c.max_range, "points at this horizontal range or beyond are out of range",
       distance(1000)},
      {"segments", &c.segments, "S: number of segments per turn", {.low = 1, .high = 3600}},
      {"bins", &c.bins, "B: number of bins per segment", {.low = 3, .high = 1000}},
      {"max_slope",
       &c.max_slope,
       "T_m: maximum slope of a line",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"flat_slope",
       &c.flat_slope,
       "T_m_small: lines with a smaller slope must also satisfy max_intercept",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"max_intercept", &c.max_intercept,
       "T_b: maximum vertical distance between a nearly flat line, extended to the sensor, "
       "and the ground below the sensor",
       distance(1000, true)},
      {"max_fit_error", &c.max_fit_error, "T_RMSE: maximum residual of a line", distance(100)},
      {"max_start_height", &c.max_start_height,
       "T_dprev: maximum height difference between the end of a line and the start of the "
       "next",
       distance(100)},
      {"long_gap", &c.long_gap,
       "maximum gap between the first two points of a line, and the gap from which "
       "max_gap_height applies",
       distance(1000)},
      {"max_gap_height", &c.max_gap_height,
       "maximum vertical distance between a line and its next point after a gap longer than "
       "long_gap",
       distance(100)},
      {"max_distance", &c.max_distance,
       "T_dground: points closer than this to their line, vertically, are ground", distance(100)},
      {"search_angle",
       &c.search_angle,
       "maximum angle to either side at which a line is searched for if the segment of a "
       "point has none",
       {.low = 0, .high = 180, .unit = "degrees"}},
  };
}

void LineFitConfig::check() const {
  LineFitConfig copy = *this;  // settings refer to members that are not const
  check_settings(method, settings_of(copy));
  check_number(method, "max_range", max_range,
               {.low = min_range,
                .high = 1000,
                .unit = "m",
                .exclusive_min = true,
                .remark = "from min_range on"});
  check_number(method, "number of bins (segments times bins)", static_cast<double>(segments) * bins,
               {.low = 3, .high = 65535});
}

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

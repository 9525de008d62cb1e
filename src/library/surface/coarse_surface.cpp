// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/coarse_surface.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/coarse_surface.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include <hwy/highway.h>

#ifndef FLAGSTONE_SURFACE_COARSE_SURFACE_ONCE
#define FLAGSTONE_SURFACE_COARSE_SURFACE_ONCE
namespace flagstone::surface {

/// A plane and the range of grid nodes that it affects.
struct PlaneOnGrid {
  float x, y, z;                                               ///< a point of the plane, metres
  float slope_x, slope_y;                                      ///< m/m
  float trust;                                                 ///< 0 to 1
  float variance;                                              ///< of the height at that point, m^2
  std::size_t first_row, last_row, first_column, last_column;  ///< inclusive
};

/// s_0: standard deviation of the height of a perfectly flat patch, metres.
inline constexpr float least_deviation = 0.05f;

/// kappa: typical curvature of ground, 1/metre. The error of a plane at distance d is kappa d^2 /
/// 2.
inline constexpr float curvature = 0.03f;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

// Plain loops, which the compiler vectorises for each instruction set.

void add_plane(const Grid& grid, const PlaneOnGrid& plane) {
  for (std::size_t row = plane.first_row; row <= plane.last_row; ++row) {
    const float dy = grid.center(row) - plane.y;
    const float height = plane.z + plane.slope_y * dy;
    const float first_x = grid.center(0);
    float* HWY_RESTRICT sums = grid.heights + row * grid.width;
    float* HWY_RESTRICT weights = grid.confidences + row * grid.width;
    for (std::size_t column = plane.first_column; column <= plane.last_column; ++column) {
      const float dx = static_cast<float>(static_cast<int>(column)) * grid.cell + first_x - plane.x;
      const float bend = curvature / 2 * (dx * dx + dy * dy);
      const float weight = plane.trust / (plane.variance + bend * bend);
      sums[column] += weight * (height + plane.slope_x * dx);
      weights[column] += weight;
    }
  }
}

/// The trend along a row of a grid.
struct TrendRow {
  HWY_INLINE TrendRow(const Grid& grid, const Trend& trend, std::size_t row)
      : first_x(grid.center(0)),
        cell(grid.cell),
        height(trend.height + trend.slope_y * grid.center(row)),
        slope(trend.slope_x) {}
  [[nodiscard]] HWY_INLINE float at(std::size_t column) const {
    return height + slope * (static_cast<float>(static_cast<int>(column)) * cell + first_x);
  }
  float first_x, cell, height, slope;
};

/// Replaces sums by means, relative to the trend; 0 for cells without weight.
void divide(const Grid& grid, const Trend& trend) {
  for (std::size_t row = 0; row < grid.width; ++row) {
    const TrendRow along(grid, trend, row);
    float* HWY_RESTRICT sums = grid.heights + row * grid.width;
    const float* HWY_RESTRICT weights = grid.confidences + row * grid.width;
    for (std::size_t column = 0; column < grid.width; ++column) {
      const float weight = weights[column];
      const float mean = sums[column] / (weight > 0 ? weight : 1.0f) - along.at(column);
      sums[column] = weight > 0 ? mean : 0.0f;
    }
  }
}

void add_trend(const Grid& grid, const Trend& trend) {
  for (std::size_t row = 0; row < grid.width; ++row) {
    const TrendRow along(grid, trend, row);
    float* HWY_RESTRICT heights = grid.heights + row * grid.width;
    for (std::size_t column = 0; column < grid.width; ++column) heights[column] += along.at(column);
  }
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(add_plane);
HWY_EXPORT(divide);
HWY_EXPORT(add_trend);

/// Planes through at least this many points have full trust.
constexpr double points_of_full_trust = 50;

/// Nodes with at least this weight are not smoothed.
constexpr float full_weight = 0.5f / (least_deviation * least_deviation);

/// Added to the variances of x and y, metres^2, so that patches within a few metres of each other
/// give no slope.
constexpr double least_spread = 30;

/// Weight of the expected height below the sensor.
constexpr float expected_weight = 0.1f / (least_deviation * least_deviation);

}  // namespace

void CoarseSurface::WeightedSums::add(const Vector3& mean, double mean_weight) noexcept {
  const auto& [mx, my, mz] = mean;
  weight += mean_weight;
  x += mean_weight * mx;
  y += mean_weight * my;
  z += mean_weight * mz;
  xx += mean_weight * mx * mx;
  xy += mean_weight * mx * my;
  yy += mean_weight * my * my;
  xz += mean_weight * mx * mz;
  yz += mean_weight * my * mz;
}

void CoarseSurface::clear() noexcept {
  std::fill_n(grid_.heights, grid_.size(), 0.0f);
  std::fill_n(grid_.confidences, grid_.size(), 0.0f);
  means_ = {};
}

void CoarseSurface::add(const Plane& plane, float size) noexcept {
  const auto x = static_cast<float>(plane.mean[0]);
  const auto y = static_cast<float>(plane.mean[1]);
  const float reach = 0.75f * size + 1.5f;
  const auto first = [&](float center) {
    const float index = std::ceil((center - reach + grid_.extent()) / grid_.cell - 0.5f);
    return static_cast<std::size_t>(std::clamp(index, 0.0f, static_cast<float>(grid_.width - 1)));
  };
  const auto last = [&](float center) {
    const float index = std::floor((center + reach + grid_.extent()) / grid_.cell - 0.5f);
    return static_cast<std::size_t>(std::clamp(index, 0.0f, static_cast<float>(grid_.width - 1)));
  };
  const PlaneOnGrid on_grid{
      .x = x,
      .y = y,
      .z = static_cast<float>(plane.mean[2]),
      .slope_x = static_cast<float>(-plane.normal[0] / plane.normal[2]),
      .slope_y = static_cast<float>(-plane.normal[1] / plane.normal[2]),
      .trust = static_cast<float>(std::min(1.0, plane.count / points_of_full_trust)),
      .variance = least_deviation * least_deviation +
                  static_cast<float>(std::max(plane.eigenvalues[2], 0.0)),
      .first_row = first(y),
      .last_row = last(y),
      .first_column = first(x),
      .last_column = last(x)};
  HWY_DYNAMIC_DISPATCH(add_plane)(grid_, on_grid);
  means_.add(plane.mean, static_cast<double>(on_grid.trust * size * size));
}

Trend CoarseSurface::trend() const noexcept {
  if (means_.weight <= 0) return {.height = expected_height_, .slope_x = 0, .slope_y = 0};
  const auto mean = [&](double sum) { return sum / means_.weight; };
  const double x = mean(means_.x);
  const double y = mean(means_.y);
  const double z = mean(means_.z);
  const double xx = mean(means_.xx) - x * x + least_spread;
  const double xy = mean(means_.xy) - x * y;
  const double yy = mean(means_.yy) - y * y + least_spread;
  const double xz = mean(means_.xz) - x * z;
  const double yz = mean(means_.yz) - y * z;
  const double determinant = xx * yy - xy * xy;  // at least least_spread^2
  const double slope_x = (xz * yy - xy * yz) / determinant;
  const double slope_y = (xx * yz - xz * xy) / determinant;
  return {.height = static_cast<float>(z - slope_x * x - slope_y * y),
          .slope_x = static_cast<float>(slope_x),
          .slope_y = static_cast<float>(slope_y)};
}

void CoarseSurface::finish(PullPush& pull_push) noexcept {
  const std::size_t half = grid_.width / 2;
  for (const std::size_t row : {half - 1, half}) {
    for (const std::size_t column : {half - 1, half}) {
      grid_.heights[row * grid_.width + column] += expected_weight * expected_height_;
      grid_.confidences[row * grid_.width + column] += expected_weight;
    }
  }
  const Trend along = trend();
  HWY_DYNAMIC_DISPATCH(divide)(grid_, along);
  pull_push.fill(grid_.heights, grid_.confidences, grid_.width, full_weight);
  HWY_DYNAMIC_DISPATCH(add_trend)(grid_, along);
  // The expected height below the sensor is not a measurement.
  if (means_.weight <= 0) std::fill_n(grid_.confidences, grid_.size(), 0.0f);
}

}  // namespace flagstone::surface
#endif

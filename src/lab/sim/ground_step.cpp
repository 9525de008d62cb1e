// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground_step.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace flagstone::sim {

std::vector<StepPlace> places_on(const GroundStep& step, const Ground& ground, const Frame& pose) {
  constexpr double spacing = 1;
  std::vector<StepPlace> places;
  for (double x = step.x_begin + spacing / 2; x < step.x_end; x += spacing) {
    const auto local = [&](double y) { return pose.to_local({x, y, ground.height(x, y)}); };
    const Vector3 begin = local(step.y_begin);
    const Vector3 end = local(step.y_end);
    // The direction across the step is horizontal, because its face may be steep.
    const Vector3 level{0, step.y_end - step.y_begin, 0};
    const double forward = dot(level, pose.forward);
    const double left = dot(level, pose.left);
    const double length = std::hypot(forward, left);
    const double across_x = forward / length;
    const double across_y = left / length;
    places.push_back({.x = begin.x,
                      .y = begin.y,
                      .across_x = across_x,
                      .across_y = across_y,
                      .width = (end.x - begin.x) * across_x + (end.y - begin.y) * across_y});
  }
  return places;
}

StepView view_step(const StepPlace& place, const HeightAt& height) {
  const auto at = [&](double across) {
    return height(place.x + across * place.across_x, place.y + across * place.across_y);
  };
  constexpr double spacing = 0.01;
  const double begin = -beside_step;
  const double end = place.width + beside_step;
  const double before = at(begin);
  StepView view{.rise = at(end) - before, .width = std::nullopt};
  if (std::isnan(view.rise) || view.rise == 0) return view;

  const int parts = static_cast<int>(std::ceil((end - begin) / spacing));
  double done_before = 0;
  double tenth = begin;  // the last position with 10 % before the first with 90 %
  for (int part = 0; part < parts; ++part) {
    const double from = begin + (end - begin) * part / parts;
    const double to = begin + (end - begin) * (part + 1) / parts;
    const double done = (at(to) - before) / view.rise;
    if (std::isnan(done)) return view;
    const auto reaches = [&](double share) {
      return from + (to - from) * (share - done_before) / (done - done_before);
    };
    if (done_before < 0.1 && done >= 0.1) tenth = reaches(0.1);
    if (done >= 0.9) {
      view.width = reaches(0.9) - tenth;
      return view;
    }
    done_before = done;
  }
  return view;
}

HeightAt true_heights(const Ground& ground, const Frame& pose) {
  return [&ground, &pose](double x, double y) {
    constexpr double high = 20;  // metres above the sensor, which is above everything
    const std::optional<double> way =
        ground.first_crossing(pose.to_world({x, y, high}), -1 * pose.up);
    return way ? high - *way : std::numeric_limits<double>::quiet_NaN();
  };
}

SeenSides seen_sides(const StepPlace& place, std::span<const float> ground_points) {
  SeenSides seen;
  for (std::size_t i = 0; i + 1 < ground_points.size(); i += 2) {
    const double dx = static_cast<double>(ground_points[i]) - place.x;
    const double dy = static_cast<double>(ground_points[i + 1]) - place.y;
    const double across = dx * place.across_x + dy * place.across_y;
    const double along = dy * place.across_x - dx * place.across_y;
    if (std::abs(along) > beside_step) continue;
    seen.before = seen.before || (across < 0 && across > -beside_step);
    seen.behind = seen.behind || (across > place.width && across < place.width + beside_step);
    if (seen.before && seen.behind) break;
  }
  return seen;
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/air.hpp"

#include <algorithm>
#include <cmath>

#include "library/core/exponential.hpp"

namespace flagstone::sim {

Air::Air(const Noise& noise, const Sensor& sensor, const Surroundings& surroundings,
         const Frame& pose, std::uint64_t seed)
    : noise_(noise), sensor_(sensor), surroundings_(surroundings), origin_(pose.origin) {
  constexpr double spread = 25;  // metres from the sensor
  constexpr double clear = 2;    // of the sensor: it does not stand in a cloud
  Random random(seed);
  for (int i = 0; i < noise.dust_clouds; ++i) {
    const double radius = random.uniform(1.5, 4);
    Vector3 from_sensor{random.uniform(-spread, spread), random.uniform(-spread, spread), 0};
    if (i == 0) {  // what the own vehicle stirs up
      const double behind = radius + clear + random.uniform(0, 4);
      from_sensor = -behind * pose.forward + random.uniform(-1, 1) * pose.left;
    }
    Vector3 centre = origin_ + from_sensor;
    centre.z = surroundings.ground().height(centre.x, centre.y) + random.uniform(0, 0.6) * radius;
    if (length(centre - origin_) < radius + clear) continue;
    clouds_.push_back({.centre = centre, .radius = radius});
  }
}

std::optional<Echo> Air::echo(Vector3 direction, double way, Random& random) const {
  const auto rain = drop(direction, way, random);
  const auto cloud = dust(direction, rain ? rain->range : way, random);
  return cloud ? cloud : rain;
}

double Air::transmission(Vector3 direction, double way) const {
  double depth = 2 * noise_.rain_extinction * way;
  for (const Cloud& cloud : clouds_) {
    depth += noise_.dust_extinction * within(cloud, direction, way).depth();
  }
  return depth == 0 ? 1 : exponential(-depth);
}

double Air::Stretch::density(double range) const noexcept {
  const double from_middle = range - middle;
  return (half_squared - from_middle * from_middle) / (radius * radius);
}

double Air::Stretch::depth() const noexcept {
  const auto up_to = [&](double range) {
    const double from_middle = range - middle;
    return (half_squared - from_middle * from_middle / 3) * from_middle;
  };
  return begin < end ? (up_to(end) - up_to(begin)) / (radius * radius) : 0;
}

Air::Stretch Air::within(const Cloud& cloud, Vector3 direction, double way) const noexcept {
  const Vector3 to_centre = cloud.centre - origin_;
  const double middle = dot(to_centre, direction);
  const double half_squared =
      cloud.radius * cloud.radius - (dot(to_centre, to_centre) - middle * middle);
  if (half_squared <= 0 || middle <= 0) return {};
  const double half = std::sqrt(half_squared);
  return {.begin = std::max(middle - half, sensor_.min_range),
          .end = std::min(middle + half, way),
          .middle = middle,
          .half_squared = half_squared,
          .radius = cloud.radius};
}

// The light that a drop sends back falls with the square of its range, and so does how often one
// is seen.
std::optional<Echo> Air::drop(Vector3 direction, double way, Random& random) const {
  if (!random.chance(noise_.rain_rate)) return std::nullopt;
  constexpr double nearest = 1;  // metres; nearer drops are out of the receiver's sight
  constexpr double farthest = 20;
  const double begin = std::max(nearest, sensor_.min_range);
  const double end = std::min(farthest, sensor_.max_range);
  if (begin >= end) return std::nullopt;
  const double range = 1 / (1 / begin - random.uniform() * (1 / begin - 1 / end));
  const double intensity = random.uniform(0, 0.1);
  if (range >= way || !surroundings_.is_clear_of_ground(origin_ + range * direction)) {
    return std::nullopt;
  }
  return Echo{.range = range,
              .intensity = intensity,
              .semantic = SemanticClass::outlier,
              .kind = EchoKind::rain};
}

std::optional<Echo> Air::dust(Vector3 direction, double way, Random& random) const {
  constexpr double step = 0.2;  // metres
  std::optional<double> first;
  for (const Cloud& cloud : clouds_) {
    const Stretch stretch = within(cloud, direction, first.value_or(way));
    for (double begin = stretch.begin; begin < stretch.end; begin += step) {
      const double end = std::min(begin + step, stretch.end);
      const double density = stretch.density((begin + end) / 2);
      if (!random.chance(noise_.dust_extinction * density * (end - begin))) continue;
      const double range = random.uniform(begin, end);
      if (!surroundings_.is_clear_of_ground(origin_ + range * direction)) continue;
      first = range;
      break;
    }
  }
  if (!first) return std::nullopt;
  return Echo{.range = *first,
              .intensity = random.uniform(0.05, 0.25),
              .semantic = SemanticClass::outlier,
              .kind = EchoKind::dust};
}

}  // namespace flagstone::sim

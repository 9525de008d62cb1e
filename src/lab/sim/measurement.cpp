// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/measurement.hpp"

#include <algorithm>
#include <cmath>

#include "library/core/exponential.hpp"

namespace flagstone::sim {

Air::Air(const Noise& noise, const Sensor& sensor, const Surroundings& surroundings,
         const Frame& pose, std::uint64_t seed)
    : noise_(noise), sensor_(sensor), surroundings_(surroundings) {
  constexpr double spread = 25;  // metres from the sensor
  constexpr double clear = 2;    // metres, so that the sensor is not in a cloud
  Random random(seed);
  for (int i = 0; i < noise.dust_clouds; ++i) {
    const double radius = random.uniform(1.5, 4);
    Vector3 from_sensor{random.uniform(-spread, spread), random.uniform(-spread, spread), 0};
    if (i == 0) {  // dust raised by the ego vehicle
      const double behind = radius + clear + random.uniform(0, 4);
      from_sensor = -behind * pose.forward + random.uniform(-1, 1) * pose.left;
    }
    Vector3 centre = pose.origin + from_sensor;
    centre.z = surroundings.ground().height(centre.x, centre.y) + random.uniform(0, 0.6) * radius;
    if (length(centre - pose.origin) < radius + clear) continue;
    clouds_.push_back({.centre = centre, .radius = radius});
  }
}

std::optional<Echo> Air::echo(Vector3 origin, Vector3 direction, double way, Random& random) const {
  const auto rain = drop(origin, direction, way, random);
  const auto cloud = dust(origin, direction, rain ? rain->range : way, random);
  return cloud ? cloud : rain;
}

double Air::transmission(Vector3 origin, Vector3 direction, double way) const {
  double depth = 2 * noise_.rain_extinction * way;
  for (const Cloud& cloud : clouds_) {
    depth += noise_.dust_extinction * within(cloud, origin, direction, way).depth();
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

Air::Stretch Air::within(const Cloud& cloud, Vector3 origin, Vector3 direction,
                         double way) const noexcept {
  const Vector3 to_centre = cloud.centre - origin;
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

// The light returned by a drop decreases with the square of its range, and so does the probability
// of its detection.
std::optional<Echo> Air::drop(Vector3 origin, Vector3 direction, double way, Random& random) const {
  if (!random.chance(noise_.rain_rate)) return std::nullopt;
  constexpr double nearest = 1;  // metres; the receiver does not see closer drops
  constexpr double farthest = 20;
  const double begin = std::max(nearest, sensor_.min_range);
  const double end = std::min(farthest, sensor_.max_range);
  if (begin >= end) return std::nullopt;
  const double range = 1 / (1 / begin - random.uniform() * (1 / begin - 1 / end));
  const double intensity = random.uniform(0, 0.1);
  if (range >= way || !surroundings_.is_clear_of_ground(origin + range * direction)) {
    return std::nullopt;
  }
  return Echo{.range = range,
              .intensity = intensity,
              .semantic = SemanticClass::outlier,
              .kind = EchoKind::rain};
}

std::optional<Echo> Air::dust(Vector3 origin, Vector3 direction, double way, Random& random) const {
  constexpr double step = 0.2;  // metres
  std::optional<double> first;
  for (const Cloud& cloud : clouds_) {
    const Stretch stretch = within(cloud, origin, direction, first.value_or(way));
    for (double begin = stretch.begin; begin < stretch.end; begin += step) {
      const double end = std::min(begin + step, stretch.end);
      const double density = stretch.density((begin + end) / 2);
      if (!random.chance(noise_.dust_extinction * density * (end - begin))) continue;
      const double range = random.uniform(begin, end);
      if (!surroundings_.is_clear_of_ground(origin + range * direction)) continue;
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

namespace {

// A random integer with this mean.
std::size_t drawn_count(double mean, Random& random) {
  const auto whole = static_cast<std::size_t>(mean);
  return whole + (random.chance(mean - static_cast<double>(whole)) ? 1 : 0);
}

// A random index below `count`, which must not be 0.
std::size_t drawn_index(std::size_t count, Random& random) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

}  // namespace

Bursts::Bursts(const Noise& noise, const Sensor& sensor, const Beams& beams, std::uint64_t seed) {
  if (noise.block_loss_rate > 0) {
    lose_blocks(noise.block_loss_rate, beams, Random::stream(seed, 0));
  }
  if (noise.crosstalk_rate > 0) {
    add_crosstalk(noise.crosstalk_rate, sensor, beams, Random::stream(seed, 1));
  }
}

// A lost block is a packet of the sensor: some firings of adjacent rows.
void Bursts::lose_blocks(double rate, const Beams& beams, Random random) {
  constexpr std::size_t blocks_a_row = 60;
  constexpr std::size_t blocks_a_column = 4;
  const std::size_t rows = beams.size() / beams.row_length();
  const std::size_t width = (beams.row_length() + blocks_a_row - 1) / blocks_a_row;
  const std::size_t height = (rows + blocks_a_column - 1) / blocks_a_column;
  lost_.resize(beams.size());
  const auto block = static_cast<double>(width * height);
  for (std::size_t left = drawn_count(rate * static_cast<double>(beams.size()) / block, random);
       left > 0; --left) {
    const std::size_t first_row = drawn_index(rows - height + 1, random);
    const std::size_t first = drawn_index(beams.row_length() - width + 1, random);
    for (std::size_t row = first_row; row < first_row + height; ++row) {
      for (std::size_t i = first; i < first + width; ++i)
        lost_[row * beams.row_length() + i] = true;
    }
  }
}

// While two sensors face each other, the false range drifts with the difference of their clocks,
// which forms a streak of points.
void Bursts::add_crosstalk(double rate, const Sensor& sensor, const Beams& beams, Random random) {
  constexpr std::size_t shortest = 8;  // firings
  constexpr std::size_t longest = 40;
  constexpr double share_hit = 0.75;
  constexpr double mean_hits = share_hit * (shortest + longest) / 2;
  constexpr double farthest = 60;  // metres
  constexpr double drift = 1;      // metres per firing
  constexpr double jitter = 0.3;   // metres
  const double reach = std::min(sensor.max_range, sensor.min_range + farthest);
  crosstalk_.resize(beams.size());
  for (std::size_t left = drawn_count(rate * static_cast<double>(beams.size()) / mean_hits, random);
       left > 0; --left) {
    const std::size_t first = drawn_index(beams.size(), random);
    const std::size_t row_end = (first / beams.row_length() + 1) * beams.row_length();
    const std::size_t end =
        std::min(first + shortest + drawn_index(longest - shortest + 1, random), row_end);
    double range = random.uniform(sensor.min_range, reach);
    const double step = random.uniform(-drift, drift);
    for (std::size_t beam = first; beam < end; ++beam, range += step) {
      const double made_up = range + random.uniform(-jitter, jitter);
      const bool hit = random.chance(share_hit);
      // A range that drifts out of reach wraps around, as a clock does.
      if (range < sensor.min_range) range = reach;
      if (range > reach) range = sensor.min_range;
      if (hit) crosstalk_[beam] = std::clamp(made_up, sensor.min_range, sensor.max_range);
    }
  }
}

namespace {

Vector3 mirrored(Vector3 direction, Vector3 normal) {
  return direction - 2 * dot(direction, normal) * normal;
}

// True for roads and pavements; soil and grass absorb the water.
bool gets_wet(SemanticClass semantic) {
  return is_ground(semantic) && semantic != SemanticClass::terrain;
}

constexpr double lost_in_mirror = 0.3;

}  // namespace

Measurement::Measurement(std::span<const Instant> instants, const Sensor& sensor,
                         const Noise& noise, const Beams& beams, std::uint64_t seed)
    : instants_(instants),
      sensor_(sensor),
      noise_(noise),
      beams_(beams),
      seed_(seed),
      bursts_(noise, sensor, beams, Random::stream(~seed, beams.size()).bits()),
      air_(noise, sensor, instants.front().surroundings, instants.front().pose,
           Random::stream(~seed, beams.size() + 1).bits()) {}

std::optional<Echo> Measurement::operator()(std::size_t beam) const {
  if (bursts_.is_lost(beam)) return std::nullopt;
  // A second stream for weather and edges, so that they do not change range, loss and intensity.
  Random extra = Random::stream(~seed_, beam);
  const Instant& instant = instants_[instants_.size() == 1 ? 0 : beam % beams_.row_length()];
  const auto& [pose, surroundings] = instant;
  const Vector3 direction = pose.direction_to_world(beams_[beam]);
  if (const auto range = bursts_.crosstalk(beam)) {
    if (surroundings.is_clear_of_ground(pose.origin + *range * direction)) {
      return Echo{.range = *range,
                  .intensity = extra.uniform(),
                  .semantic = SemanticClass::outlier,
                  .kind = EchoKind::crosstalk};
    }
  }
  const auto met = surroundings.cast(pose.origin, direction, sensor_.min_range, sensor_.max_range);
  if (const auto air =
          air_.echo(pose.origin, direction, met ? met->range : sensor_.max_range, extra)) {
    return air;
  }
  if (!met) return std::nullopt;
  return echo_of_surface(instant, direction, *met, Random::stream(seed_, beam), extra);
}

std::optional<Echo> Measurement::echo_of_surface(const Instant& instant, Vector3 direction,
                                                 const Meeting& met, Random random,
                                                 Random& extra) const {
  if (const double share = share_mirrored(met); share > 0 && extra.chance(share)) {
    return seen_in_mirror(instant, direction, met, extra);
  }
  if (is_ground(met.surface->semantic)) {
    if (const auto ghost = ghost_below(instant, direction, met, random)) return ghost;
  }
  if (noise_.mixed_rate > 0 && extra.chance(noise_.mixed_rate)) {
    if (const auto mixed = mixed_at_edge(instant, direction, met, extra)) return mixed;
  }
  double reflectivity = met.surface->reflectivity;
  constexpr double darker_when_wet = 0.5;
  if (gets_wet(met.surface->semantic)) reflectivity *= 1 - darker_when_wet * noise_.wetness;
  reflectivity *= air_.transmission(instant.pose.origin, direction, met.range);
  if (!is_detected(noise_, met.range, reflectivity, met.incidence, random)) return std::nullopt;
  auto echo = reported(met.range, reflectivity, met.incidence, labelled_class(*met.surface),
                       EchoKind::surface, random);
  if (echo) echo->motion = met.surface->motion;
  return echo;
}

// Smooth surfaces reflect a tenth of a mirror's light at right angles, and all of it at grazing
// incidence. C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
double Measurement::share_mirrored(const Meeting& met) const noexcept {
  double mirror = noise_.mirroring * double{met.surface->mirror};
  if (gets_wet(met.surface->semantic)) mirror = std::max(mirror, noise_.wetness);
  if (mirror == 0) return 0;
  constexpr double upright = 0.1;
  const double grazing = 1 - met.incidence;
  const double squared = grazing * grazing;
  return mirror * (upright + (1 - upright) * squared * squared * grazing);
}

// The beam is reflected specularly and returns along the same path, but the sensor reports the
// point straight ahead, behind the surface. No point is reported on the ground, where its
// ground-truth label would be ambiguous. If the reflected beam hits nothing, there is no return.
std::optional<Echo> Measurement::seen_in_mirror(const Instant& instant, Vector3 direction,
                                                const Meeting& mirror, Random& random) const {
  constexpr double clear_of_mirror = 0.05;
  const auto object = instant.surroundings.cast(instant.pose.origin + mirror.range * direction,
                                                mirrored(direction, mirror.normal), clear_of_mirror,
                                                sensor_.max_range - mirror.range);
  if (!object) return std::nullopt;
  const double path = mirror.range + object->range;
  const Vector3 point = instant.pose.origin + path * direction;
  const bool stands =
      is_ground(mirror.surface->semantic)
          ? !is_ground(object->surface->semantic) && instant.surroundings.is_below_ground(point)
          : instant.surroundings.is_clear_of_ground(point);
  const double reflectivity = lost_in_mirror * object->surface->reflectivity *
                              air_.transmission(instant.pose.origin, direction, mirror.range);
  if (!stands || !is_detected(noise_, path, reflectivity, object->incidence, random)) {
    return std::nullopt;
  }
  return reported(path, reflectivity, object->incidence, SemanticClass::outlier, EchoKind::ghost,
                  random);
}

// A ghost point on dry ground, which is rare: the specular reflection of an object on the ground.
std::optional<Echo> Measurement::ghost_below(const Instant& instant, Vector3 direction,
                                             const Meeting& mirror, Random& random) const {
  if (!is_mirrored(noise_, mirror.range, random)) return std::nullopt;
  constexpr double clear_of_mirror = 0.05;
  const auto object = instant.surroundings.cast(instant.pose.origin + mirror.range * direction,
                                                mirrored(direction, mirror.normal), clear_of_mirror,
                                                noise_.ghost_max_range - mirror.range);
  if (!object || is_ground(object->surface->semantic)) return std::nullopt;
  const double path = mirror.range + object->range;
  if (!instant.surroundings.is_below_ground(instant.pose.origin + path * direction))
    return std::nullopt;
  return reported(path, lost_in_mirror * object->surface->reflectivity, object->incidence,
                  SemanticClass::outlier, EchoKind::ghost, random);
}

// A beam has a width. If part of it hits another surface, closer or farther by less than the length
// of a pulse, the sensor merges both returns and reports a range between them.
std::optional<Echo> Measurement::mixed_at_edge(const Instant& instant, Vector3 direction,
                                               const Meeting& met, Random& random) const {
  constexpr double least_gap = 0.3;  // metres; smaller gaps are within the range noise
  constexpr double pulse_length = 3;
  constexpr double straight_up = 0.9;
  const Vector3 axis = std::abs(dot(direction, instant.pose.up)) < straight_up
                           ? instant.pose.up
                           : instant.pose.forward;
  const Vector3 across = normalized(cross(direction, axis));
  const Vector3 upward = cross(across, direction);
  const double half_width = noise_.beam_width / 2;
  const Vector3 beside = normalized(direction + half_width * random.uniform(-1, 1) * across +
                                    half_width * random.uniform(-1, 1) * upward);
  const auto other =
      instant.surroundings.cast(instant.pose.origin, beside, sensor_.min_range, sensor_.max_range);
  if (!other) return std::nullopt;

  // There is no edge if one hit is on the plane of the other: that is one surface at grazing
  // incidence.
  const auto on_plane = [](const Meeting& of, Vector3 along, Vector3 to) {
    return of.range * dot(of.normal, along) / dot(of.normal, to);
  };
  const double gap = other->range - met.range;
  const double off_plane = std::abs(other->range - on_plane(met, direction, beside));
  const double off_other = std::abs(met.range - on_plane(*other, beside, direction));
  if (std::abs(gap) < least_gap || std::abs(gap) > pulse_length || !(off_plane > least_gap) ||
      !(off_other > least_gap)) {
    return std::nullopt;
  }
  const double share = random.uniform(0.15, 0.85);  // outside, the return is of one surface
  const double range = met.range + share * gap;
  if (!instant.surroundings.is_clear_of_ground(instant.pose.origin + range * direction))
    return std::nullopt;
  const double reflectivity =
      air_.transmission(instant.pose.origin, direction, range) *
      ((1 - share) * met.surface->reflectivity + share * other->surface->reflectivity);
  const double incidence = (1 - share) * met.incidence + share * other->incidence;
  if (!is_detected(noise_, range, reflectivity, incidence, random)) return std::nullopt;
  return reported(range, reflectivity, incidence, SemanticClass::outlier, EchoKind::mixed, random);
}

std::optional<Echo> Measurement::reported(double range, double reflectivity, double incidence,
                                          SemanticClass semantic, EchoKind kind,
                                          Random& random) const {
  const double measured = measured_range(noise_, sensor_, range, random);
  if (measured < sensor_.min_range || measured > sensor_.max_range) return std::nullopt;
  return Echo{.range = measured,
              .intensity = measured_intensity(noise_, reflectivity, incidence, random),
              .semantic = semantic,
              .kind = kind};
}

}  // namespace flagstone::sim

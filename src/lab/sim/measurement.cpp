// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/measurement.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone::sim {
namespace {

Vector3 mirrored(Vector3 direction, Vector3 normal) {
  return direction - 2 * dot(direction, normal) * normal;
}

// Roads and pavements; soil and grass drink the water.
bool gets_wet(SemanticClass semantic) {
  return is_ground(semantic) && semantic != SemanticClass::terrain;
}

constexpr double lost_in_mirror = 0.3;

}  // namespace

Measurement::Measurement(const Surroundings& surroundings, const Sensor& sensor, const Noise& noise,
                         const Beams& beams, const Frame& pose, std::uint64_t seed)
    : surroundings_(surroundings),
      sensor_(sensor),
      noise_(noise),
      beams_(beams),
      pose_(pose),
      seed_(seed),
      bursts_(noise, sensor, beams, Random::stream(~seed, beams.size()).bits()),
      air_(noise, sensor, surroundings, pose, Random::stream(~seed, beams.size() + 1).bits()) {}

std::optional<Echo> Measurement::operator()(std::size_t beam) const {
  if (bursts_.is_lost(beam)) return std::nullopt;
  // Two streams, so that what weather and edges draw leaves range, loss and intensity as they are.
  Random extra = Random::stream(~seed_, beam);
  const Vector3 direction = pose_.direction_to_world(beams_[beam]);
  if (const auto range = bursts_.crosstalk(beam)) {
    if (surroundings_.is_clear_of_ground(pose_.origin + *range * direction)) {
      return Echo{.range = *range,
                  .intensity = extra.uniform(),
                  .semantic = SemanticClass::outlier,
                  .kind = EchoKind::crosstalk};
    }
  }
  const auto met =
      surroundings_.cast(pose_.origin, direction, sensor_.min_range, sensor_.max_range);
  if (const auto air = air_.echo(direction, met ? met->range : sensor_.max_range, extra)) {
    return air;
  }
  if (!met) return std::nullopt;
  return echo_of_surface(direction, *met, Random::stream(seed_, beam), extra);
}

std::optional<Echo> Measurement::echo_of_surface(Vector3 direction, const Meeting& met,
                                                 Random random, Random& extra) const {
  if (const double share = share_mirrored(met); share > 0 && extra.chance(share)) {
    return seen_in_mirror(direction, met, extra);
  }
  if (is_ground(met.surface->semantic)) {
    if (const auto ghost = ghost_below(direction, met, random)) return ghost;
  }
  if (noise_.mixed_rate > 0 && extra.chance(noise_.mixed_rate)) {
    if (const auto mixed = mixed_at_edge(direction, met, extra)) return mixed;
  }
  double reflectivity = met.surface->reflectivity;
  constexpr double darker_when_wet = 0.5;
  if (gets_wet(met.surface->semantic)) reflectivity *= 1 - darker_when_wet * noise_.wetness;
  reflectivity *= air_.transmission(direction, met.range);
  if (!is_detected(noise_, met.range, reflectivity, met.incidence, random)) return std::nullopt;
  return reported(met.range, reflectivity, met.incidence, met.surface->semantic, EchoKind::surface,
                  random);
}

// As of smooth surfaces: a tenth of a mirror's light at right angles, all of it at grazing
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

// The beam goes on the mirrored way, comes back by it, and the sensor, which knows of no mirror,
// puts the point straight on. Where that is on the ground nothing is reported: it would be a ghost
// that no truth can tell from ground. What the mirror lost sight of is lost as well.
std::optional<Echo> Measurement::seen_in_mirror(Vector3 direction, const Meeting& mirror,
                                                Random& random) const {
  constexpr double clear_of_mirror = 0.05;
  const auto object = surroundings_.cast(pose_.origin + mirror.range * direction,
                                         mirrored(direction, mirror.normal), clear_of_mirror,
                                         sensor_.max_range - mirror.range);
  if (!object) return std::nullopt;
  const double path = mirror.range + object->range;
  const Vector3 point = pose_.origin + path * direction;
  const bool stands = is_ground(mirror.surface->semantic) ? !is_ground(object->surface->semantic) &&
                                                                surroundings_.is_below_ground(point)
                                                          : surroundings_.is_clear_of_ground(point);
  const double reflectivity =
      lost_in_mirror * object->surface->reflectivity * air_.transmission(direction, mirror.range);
  if (!stands || !is_detected(noise_, path, reflectivity, object->incidence, random)) {
    return std::nullopt;
  }
  return reported(path, reflectivity, object->incidence, SemanticClass::outlier, EchoKind::ghost,
                  random);
}

// Rare on dry ground: what stands on it, mirrored in it, lies below it.
std::optional<Echo> Measurement::ghost_below(Vector3 direction, const Meeting& mirror,
                                             Random& random) const {
  if (!is_mirrored(noise_, mirror.range, random)) return std::nullopt;
  constexpr double clear_of_mirror = 0.05;
  const auto object = surroundings_.cast(pose_.origin + mirror.range * direction,
                                         mirrored(direction, mirror.normal), clear_of_mirror,
                                         noise_.ghost_max_range - mirror.range);
  if (!object || is_ground(object->surface->semantic)) return std::nullopt;
  const double path = mirror.range + object->range;
  if (!surroundings_.is_below_ground(pose_.origin + path * direction)) return std::nullopt;
  return reported(path, lost_in_mirror * object->surface->reflectivity, object->incidence,
                  SemanticClass::outlier, EchoKind::ghost, random);
}

// A beam is as wide as its light spreads. Where half of it meets something else, less than a
// pulse's length nearer or farther, the two echoes are one for the sensor, and the range lies
// between.
std::optional<Echo> Measurement::mixed_at_edge(Vector3 direction, const Meeting& met,
                                               Random& random) const {
  constexpr double least_gap = 0.3;  // metres; less is lost in the range noise
  constexpr double pulse_length = 3;
  constexpr double straight_up = 0.9;
  const Vector3 axis = std::abs(dot(direction, pose_.up)) < straight_up ? pose_.up : pose_.forward;
  const Vector3 across = normalized(cross(direction, axis));
  const Vector3 upward = cross(across, direction);
  const double half_width = noise_.beam_width / 2;
  const Vector3 beside = normalized(direction + half_width * random.uniform(-1, 1) * across +
                                    half_width * random.uniform(-1, 1) * upward);
  const auto other = surroundings_.cast(pose_.origin, beside, sensor_.min_range, sensor_.max_range);
  if (!other) return std::nullopt;

  // Not an edge where the one lies on the plane of the other: that is one surface at grazing
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
  const double share = random.uniform(0.15, 0.85);  // beyond, it is one surface's echo
  const double range = met.range + share * gap;
  if (!surroundings_.is_clear_of_ground(pose_.origin + range * direction)) return std::nullopt;
  const double reflectivity =
      air_.transmission(direction, range) *
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

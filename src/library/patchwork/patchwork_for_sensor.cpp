// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Derives the settings of Patchwork from the positions where the beams of a sensor meet flat
// ground. docs/explanation/settings-from-a-sensor.md describes the rule.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone {
namespace {

/// A ring around a sensor, and the number of its points on flat ground.
struct GroundRing {
  double inner = 0;   ///< metres
  double outer = 0;   ///< metres
  int beams = 0;      ///< beams that meet flat ground in the ring; 0 beyond the last beam
  double points = 0;  ///< points per full turn; beyond the last beam, the points of one beam

  [[nodiscard]] double length() const noexcept { return outer - inner; }
  [[nodiscard]] double middle() const noexcept { return (inner + outer) / 2; }
};

/// The positions where the beams of a sensor meet flat ground at its height, and the number of
/// points per beam and full turn. A rosette is treated as beams that distribute its points evenly
/// over its field of view.
class GroundBeams {
 public:
  explicit GroundBeams(const Sensor& sensor);

  /// Distances from the point below the sensor, metres, ascending: height / tan(-elevation).
  /// Excludes beams that do not meet ground within the range of the sensor.
  [[nodiscard]] const std::vector<double>& radii() const noexcept { return radii_; }

  /// Maximum distance at which beams meet sloped ground, up to the range of the sensor; metres.
  /// `slope` is in m/m.
  [[nodiscard]] double reach(double slope) const noexcept;

  /// Number of points per beam and full turn; a narrow field of view contains a part of them.
  [[nodiscard]] double points_a_turn() const noexcept { return points_a_turn_; }

 private:
  std::vector<double> radii_;
  double least_fall_ = 0;  ///< downward slope of the highest beam, m/m; negative if it points up
  double height_ = 0;
  double max_range_ = 0;
  double points_a_turn_ = 0;
};

/// Minimum lengths of rings.
struct RingLengths {
  double first = 0;     ///< minimum for the first ring, metres
  double shortest = 0;  ///< minimum for the other rings, metres
  double one_beam = 0;  ///< minimum for rings with only one beam, metres
  double growth = 0;    ///< minimum for the other rings, as a fraction of their mean radius
  double beyond = 0;  ///< length of rings beyond the last beam, as a fraction of their inner radius
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Elevations of beams that give the same number of points with equal horizontal and vertical
/// spacing.
std::vector<double> beams_of_rosette(const Sensor& sensor) {
  const double height = sensor.elevations.front() - sensor.elevations.back();
  const double width = sensor.azimuth_end - sensor.azimuth_begin;
  const double count = std::clamp(std::round(std::sqrt(sensor.firings * height / width)), 2.0, 1e3);
  std::vector<double> elevations(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    elevations[i] = sensor.elevations.front() - height * static_cast<double>(i) / (count - 1);
  }
  return elevations;
}

/// Radius of the edge after beam `i`, metres.
double edge_after(const std::vector<double>& radii, std::size_t i) {
  if (i + 1 < radii.size()) return (radii[i] + radii[i + 1]) / 2;
  const double gap = i > 0 ? radii[i] - radii[i - 1] : radii[i];
  return radii[i] + std::max(gap / 2, radii[i] / 20);
}

bool is_long_enough(const GroundRing& ring, bool is_first, const RingLengths& lengths) {
  const double least = lengths.growth * ring.middle();
  if (ring.beams < 2 && ring.length() < std::max(lengths.one_beam, least)) return false;
  return ring.length() >= (is_first ? lengths.first : std::max(lengths.shortest, least));
}

/// Rings of the beams that meet flat ground.
std::vector<GroundRing> rings_of_beams(const GroundBeams& beams, double begin,
                                       const RingLengths& lengths) {
  const std::vector<double>& radii = beams.radii();
  std::vector<GroundRing> rings;
  GroundRing ring{.inner = begin};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] <= begin) continue;
    ring.outer = edge_after(radii, i);
    ++ring.beams;
    ring.points += beams.points_a_turn();
    if (!is_long_enough(ring, rings.empty(), lengths)) continue;
    rings.push_back(ring);
    ring = {.inner = ring.outer};
  }
  if (ring.beams == 0) return rings;
  // The rest is too short for a separate ring.
  if (rings.empty()) return {ring};
  rings.back().outer = ring.outer;
  rings.back().beams += ring.beams;
  rings.back().points += ring.points;
  return rings;
}

GroundBeams::GroundBeams(const Sensor& sensor)
    : least_fall_(-std::tan(radians(std::min(sensor.elevations.front(), 89.0)))),
      height_(sensor.height),
      max_range_(sensor.max_range) {
  const std::vector<double> elevations =
      sensor.draws_rosette() ? beams_of_rosette(sensor) : sensor.elevations;
  for (const double elevation : elevations) {
    const double fall = std::sin(radians(-elevation));
    if (fall <= 0 || sensor.height >= sensor.max_range * fall) continue;
    radii_.push_back(sensor.height / std::tan(radians(-elevation)));
  }
  std::ranges::sort(radii_);
  const double firings = sensor.draws_rosette()
                             ? sensor.firings / static_cast<double>(elevations.size())
                             : sensor.firings;
  points_a_turn_ = firings * 360 / (sensor.azimuth_end - sensor.azimuth_begin);
}

double GroundBeams::reach(double slope) const noexcept {
  const double fall = least_fall_ - slope;  // relative to sloped ground
  return fall * max_range_ <= height_ ? max_range_ : height_ / fall;
}

/// Rings from `begin` metres outwards, each as short as `lengths` allow. As long as beams meet flat
/// ground, edges are halfway between beams and every ring has a beam. Beyond them are rings up to
/// `reach` metres, for sloped ground. Empty if no beam meets flat ground beyond `begin`.
std::vector<GroundRing> ground_rings(const GroundBeams& beams, double begin, double reach,
                                     const RingLengths& lengths) {
  std::vector<GroundRing> rings = rings_of_beams(beams, begin, lengths);
  if (rings.empty()) return rings;
  while (rings.back().outer * (1 + lengths.beyond) <= reach) {
    const double inner = rings.back().outer;
    rings.push_back(
        {.inner = inner, .outer = inner * (1 + lengths.beyond), .points = beams.points_a_turn()});
  }
  return rings;
}

/// h_s for which the settings of `default` were chosen, metres. Distances that correspond to an
/// angle below the sensor scale with the height.
constexpr double height_of_default = 1.73;

/// Minimum lengths of rings. The first ring is long, because beams are dense there and objects near
/// the sensor occlude much of a small bin.
constexpr double first_length = 2.2;      // in heights of the sensor
constexpr double shortest_length = 1.04;  // in heights of the sensor
constexpr double one_beam_length = 1.8;   // metres; also an upper limit of shortest_length
constexpr double length_growth = 0.15;    // m/m
constexpr double length_beyond = 0.2;     // m/m, beyond the last beam
constexpr double rise_beyond = 0.1;       // slope of the ground beyond the last beam, m/m

/// Minimum number of points of a bin on flat ground, if the sensor has that many.
constexpr double fewest_points = 20;
constexpr double fewest_sectors = 4;  // per full turn, so that a bin is on one side of the sensor

/// Neighbouring rings form one zone if their numbers of sectors are within this factor.
constexpr double same_sectors = 1.3;
constexpr std::size_t most_zones = 16;

/// Range in which reflections below the ground are not seeds, in heights of the sensor: Z_1 of
/// `default`.
constexpr double near_ground = 9.576 / height_of_default;

constexpr double ground_roughness = 0.035;  // RMS roughness of even ground, metres
constexpr double view_margin = 1;           // degrees, on both sides of a narrow field of view

constexpr double lowest_height = 0.01;  // metres

/// Rounds to four digits, for readability and to hide differences between mathematical libraries.
float rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 3);
  return static_cast<float>(std::round(value / unit) * unit);
}

/// Number of sectors per full turn of this ring. Bins are as wide as long, or wider if they would
/// have too few points.
double sectors_of(const GroundRing& ring) {
  const double as_wide_as_long = 2 * std::numbers::pi * ring.middle() / ring.length();
  return std::max(fewest_sectors, std::min(as_wide_as_long, ring.points / fewest_points));
}

/// Consecutive rings, and the range of their numbers of sectors.
struct RingGroup {
  std::size_t first = 0;
  std::size_t last = 0;
  double fewest = 0;
  double most = 0;

  /// Geometric mean of both.
  [[nodiscard]] double sectors() const { return std::sqrt(fewest * most); }
};

/// Groups neighbouring rings whose numbers of sectors are within a factor of each other.
std::vector<RingGroup> grouped(const std::vector<GroundRing>& rings, double factor) {
  std::vector<RingGroup> groups;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const double sectors = sectors_of(rings[i]);
    if (!groups.empty()) {
      RingGroup& group = groups.back();
      const double fewest = std::min(group.fewest, sectors);
      const double most = std::max(group.most, sectors);
      if (most <= factor * fewest) {
        group = {.first = group.first, .last = i, .fewest = fewest, .most = most};
        continue;
      }
    }
    groups.push_back({.first = i, .last = i, .fewest = sectors, .most = sectors});
  }
  return groups;
}

/// M_h: a tenth of the sensor height below the ground, at least 17 cm (the value for 1.73 m). Only
/// near the sensor, where reflections occur.
float height_margin(double outer, double height) {
  if (outer > near_ground * height) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(-1 - std::max(0.1, 0.17 / height));
}

FieldOfView view_of(const Sensor& sensor) {
  const double width = sensor.azimuth_end - sensor.azimuth_begin + 2 * view_margin;
  if (width >= 360) return {};
  return {.begin = static_cast<float>(sensor.azimuth_begin - view_margin),
          .width = static_cast<float>(width)};
}

/// sigma_tau: the surface variable of an evenly filled bin whose points deviate from their plane by
/// the range noise and the roughness of even ground.
float flatness_threshold(const GroundRing& ring, double sectors, double range_sigma) {
  const double width = 2 * std::numbers::pi * ring.middle() / sectors;
  const double spread = (ring.length() * ring.length() + width * width) / 12;
  const double rough = range_sigma * range_sigma + ground_roughness * ground_roughness;
  return rounded(std::min(0.3333, rough / spread));
}

/// L_min: closer points belong to the ego vehicle. It is h_s (45 degrees below the sensor), or 0.9
/// times the distance of the nearest ground if that is smaller, but at least h_s / 2 and the
/// minimum range.
double begin_of(const Sensor& sensor, const GroundBeams& beams) {
  const double nearest = beams.radii().empty() ? sensor.height : 0.9 * beams.radii().front();
  return std::max(sensor.min_range, std::clamp(nearest, sensor.height / 2, sensor.height));
}

/// kappa and L_tau, scaled to the height of the sensor.
ElevationTerm scaled(ElevationTerm term, double height) {
  const double scale = height / height_of_default;
  term.base = rounded(term.base * scale);
  term.growth = rounded(std::min(1.0, term.growth / scale));
  term.range = rounded(term.range * scale);
  return term;
}

}  // namespace

PatchworkConfig PatchworkConfig::for_sensor(const Sensor& sensor) {
  sensor.check();
  if (sensor.height < lowest_height) {
    throw std::invalid_argument(
        "sensor " + sensor.name + ": height = " + std::to_string(sensor.height) +
        " m is out of range (expected at least 0.01 m; zones depend on it)");
  }
  const GroundBeams beams(sensor);
  const RingLengths lengths{.first = first_length * sensor.height,
                            .shortest = std::min(shortest_length * sensor.height, one_beam_length),
                            .one_beam = one_beam_length,
                            .growth = length_growth,
                            .beyond = length_beyond};
  double begin = begin_of(sensor, beams);
  std::vector<GroundRing> rings = ground_rings(beams, begin, beams.reach(rise_beyond), lengths);
  if (rings.empty()) rings = ground_rings(beams, begin = 0, beams.reach(rise_beyond), lengths);
  if (rings.empty()) {
    throw std::invalid_argument(
        "sensor " + sensor.name + ": no beam meets flat ground " + std::to_string(sensor.height) +
        " m below the sensor within max_range = " + std::to_string(sensor.max_range) + " m");
  }
  rings.back().outer = std::min(rings.back().outer, sensor.max_range);

  PatchworkConfig config;
  config.sensor_height = static_cast<float>(sensor.height);
  config.min_range = rounded(begin);
  config.field_of_view = view_of(sensor);
  config.distance_margin =
      std::max(config.distance_margin, static_cast<float>(4 * sensor.range_sigma));
  config.elevation = scaled(config.elevation, sensor.height);
  config.zones.clear();
  config.flatness.thresholds.clear();

  double factor = same_sectors;
  std::vector<RingGroup> groups = grouped(rings, factor);
  while (groups.size() > most_zones) groups = grouped(rings, factor *= same_sectors);
  const double share = config.field_of_view.width / 360.0;
  for (const RingGroup& group : groups) {
    const double sectors = std::max(1.0, std::round(share * group.sectors()));
    Zone zone{.ring_radii = {}, .sectors = static_cast<int>(sectors)};
    for (std::size_t i = group.first; i <= group.last; ++i) {
      zone.ring_radii.push_back(rounded(rings[i].outer));
      config.flatness.thresholds.push_back(
          flatness_threshold(rings[i], sectors / share, sensor.range_sigma));
    }
    zone.height_margin = height_margin(rings[group.last].outer, sensor.height);
    config.zones.push_back(std::move(zone));
  }
  return config;
}

PatchworkConfig PatchworkConfig::for_sensor(std::string_view name) {
  return for_sensor(Sensor::named(name));
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The rule of docs/reference/sensors.md: Patchwork's settings from where a sensor's beams meet flat
// ground.
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

/// A ring around a sensor, and the points that it has on flat ground there.
struct GroundRing {
  double inner = 0;   ///< metres
  double outer = 0;   ///< metres
  int beams = 0;      ///< that meet flat ground between them; 0 beyond the last
  double points = 0;  ///< in one full turn; of one beam beyond the last

  [[nodiscard]] double length() const noexcept { return outer - inner; }
  [[nodiscard]] double middle() const noexcept { return (inner + outer) / 2; }
};

/// Where the beams of a sensor meet flat ground `height` metres below it, and how many points each
/// of them has in a full turn. A rosette counts as beams that share out its points evenly over its
/// field of view.
class GroundBeams {
 public:
  explicit GroundBeams(const Sensor& sensor);

  /// Distances from the point below the sensor, metres, ascending: height / tan(-elevation). Beams
  /// that meet no ground within the sensor's range are not among them.
  [[nodiscard]] const std::vector<double>& radii() const noexcept { return radii_; }

  /// How far the beams meet ground that rises by `slope`, metres a metre, up to the sensor's range;
  /// metres.
  [[nodiscard]] double reach(double slope) const noexcept;

  /// Points of a beam in a full turn; a narrow field of view holds its share of them.
  [[nodiscard]] double points_a_turn() const noexcept { return points_a_turn_; }

 private:
  std::vector<double> radii_;
  double least_fall_ = 0;  ///< of the flattest beam, metres a metre; negative where it rises
  double height_ = 0;
  double max_range_ = 0;
  double points_a_turn_ = 0;
};

/// How long rings are to be.
struct RingLengths {
  double first = 0;     ///< shortest length of the first ring, metres
  double shortest = 0;  ///< of the others, metres
  double one_beam = 0;  ///< of rings that hold one beam only, metres
  double growth = 0;    ///< of the others as a share of the distance of their middle
  double beyond = 0;    ///< of rings beyond the last beam, as a share of the distance they begin at
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Elevations of as many beams as would draw the same number of points one angle apart both ways.
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

/// Rings of those beams that meet flat ground.
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
  // What is left is too short for a ring of its own.
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
  const double fall = least_fall_ - slope;  // towards ground that rises beams fall less
  return fall * max_range_ <= height_ ? max_range_ : height_ / fall;
}

/// Rings from `begin` metres outward, each as short as `lengths` allow: while beams meet flat
/// ground, edges halfway between them and no ring without one; then rings up to `reach` metres, for
/// ground that rises. Empty where no beam meets flat ground beyond `begin`.
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

/// h_s that the settings of `default` were found at, metres. What is a distance seen at some angle
/// from above is scaled with the height.
constexpr double height_of_default = 1.73;

/// Shortest rings. The first is long, for beams are dense there and what stands near the sensor
/// hides much of a small bin.
constexpr double first_length = 2.2;      // heights of the sensor
constexpr double shortest_length = 1.04;  // heights of the sensor, and
constexpr double one_beam_length = 1.8;   // metres: as much as a ring with one beam has to have
constexpr double length_growth = 0.15;    // metres a metre
constexpr double length_beyond = 0.2;     // metres a metre, beyond the last beam
constexpr double rise_beyond = 0.1;       // of ground that is looked for there, metres a metre

/// Points on flat ground that a bin has at least, where the sensor has that many.
constexpr double fewest_points = 20;
constexpr double fewest_sectors = 4;  // of a full turn: a bin sees ground to one side of the sensor

/// Neighbouring rings are one zone where the sector counts they ask for are within this factor.
constexpr double same_sectors = 1.3;
constexpr std::size_t most_zones = 16;

/// Where reflections below the ground are no seeds: Z_1 of `default`, heights of the sensor.
constexpr double near_ground = 9.576 / height_of_default;

constexpr double ground_roughness = 0.035;  // metres, rms, of ground that counts as even
constexpr double view_margin = 1;           // degrees on both sides of a narrow field of view

constexpr double lowest_height = 0.01;  // metres

/// To four digits: it reads well, and no difference between mathematics libraries shows.
float rounded(double value) {
  if (value == 0) return 0;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 3);
  return static_cast<float>(std::round(value / unit) * unit);
}

/// Sectors that a full turn of this ring is cut into: bins as wide as long, wider where they would
/// have too few points.
double sectors_of(const GroundRing& ring) {
  const double as_wide_as_long = 2 * std::numbers::pi * ring.middle() / ring.length();
  return std::max(fewest_sectors, std::min(as_wide_as_long, ring.points / fewest_points));
}

/// Rings first to last, and the sectors they ask for.
struct RingGroup {
  std::size_t first = 0;
  std::size_t last = 0;
  double fewest = 0;
  double most = 0;

  /// Between both in ratio.
  [[nodiscard]] double sectors() const { return std::sqrt(fewest * most); }
};

/// Neighbouring rings whose sectors are within a factor of each other.
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

/// M_h: a tenth of the height below the ground, at least the 17 cm that this is at 1.73 m, near the
/// sensor, where reflections come from.
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

/// sigma_tau: the flatness of a bin, evenly filled, whose points are off their plane by the range's
/// noise and the roughness of even ground.
float flatness_threshold(const GroundRing& ring, double sectors, double range_sigma) {
  const double width = 2 * std::numbers::pi * ring.middle() / sectors;
  const double spread = (ring.length() * ring.length() + width * width) / 12;
  const double rough = range_sigma * range_sigma + ground_roughness * ground_roughness;
  return rounded(std::min(0.3333, rough / spread));
}

/// L_min: what lies nearer is the own vehicle. As near as the sensor is high, 45 degrees below, or
/// a little less far than ground is seen, half as near at least.
double begin_of(const Sensor& sensor, const GroundBeams& beams) {
  const double nearest = beams.radii().empty() ? sensor.height : 0.9 * beams.radii().front();
  return std::max(sensor.min_range, std::clamp(nearest, sensor.height / 2, sensor.height));
}

/// kappa and L_tau as seen from the sensor's height.
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The rule that derives the settings of Patchwork from a sensor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "flagstone/patchwork.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone {
namespace {

using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

/// Minimum number of points of a bin on flat ground, and the fraction of bins that may have fewer.
/// These are at the edges of zones, where the number of sectors is a compromise between rings.
constexpr std::size_t fewest_points = 15;
constexpr double share_with_fewer = 0.1;

/// Distance at which a beam at this angle meets flat ground.
Point on_flat_ground(const Sensor& sensor, double elevation, double azimuth) {
  const double range = sensor.height / std::tan(-elevation * degree);
  return {static_cast<float>(range * std::cos(azimuth * degree)),
          static_cast<float>(range * std::sin(azimuth * degree)),
          static_cast<float>(-sensor.height)};
}

/// Lines of points of a sensor on the ground.
struct Lines {
  std::vector<double> elevations;
  int points = 0;  ///< number of points per line
};

/// The points of a rosette as lines that are evenly spaced in its field of view.
Lines lines_of(const Sensor& sensor) {
  if (!sensor.draws_rosette()) return {sensor.elevations, sensor.firings};
  const int count = static_cast<int>(std::sqrt(sensor.firings));
  Lines lines{.elevations = {}, .points = sensor.firings / count};
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    lines.elevations.push_back(std::lerp(sensor.elevations[0], sensor.elevations[1], share));
  }
  return lines;
}

bool meets_flat_ground(const Sensor& sensor, double elevation) {
  return elevation < 0 && sensor.height < sensor.max_range * std::sin(-elevation * degree);
}

/// A scan of flat ground only.
std::vector<Point> flat_scan(const Sensor& sensor) {
  const double width = sensor.azimuth_end - sensor.azimuth_begin;
  const Lines lines = lines_of(sensor);
  std::vector<Point> points;
  for (const double elevation : lines.elevations) {
    if (!meets_flat_ground(sensor, elevation)) continue;
    for (int i = 0; i < lines.points; ++i) {
      const double azimuth = sensor.azimuth_begin + width * (i + 0.5) / lines.points;
      points.push_back(on_flat_ground(sensor, elevation, azimuth));
    }
  }
  return points;
}

std::size_t bins_of(const PatchworkConfig& config) {
  std::size_t bins = 0;
  for (const Zone& zone : config.zones) {
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  return bins;
}

/// Any sensor: few or many beams, evenly spaced or not, full or narrow field of view, low or high.
Sensor any_sensor() {
  const auto between = [](double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000;
  };
  Sensor sensor{.name = "any", .title = "any", .elevations = {between(-60, -2)}};
  const int beams = *rc::gen::element(1, 2, 4, 8, 16, 32, 64, 128);
  const double spread = between(0.05, 3);
  for (int i = 1; i < beams; ++i) {
    const double next = sensor.elevations.back() + between(0.01, 2 * spread);
    if (next > 90) break;
    sensor.elevations.push_back(next);
  }
  std::ranges::sort(sensor.elevations, std::greater());
  sensor.firings = *rc::gen::inRange(500, 4000);
  if (*rc::gen::arbitrary<bool>()) {
    sensor.azimuth_begin = between(-180, 180);
    sensor.azimuth_end = std::min(sensor.azimuth_begin + between(10, 359), 360.0);
  }
  sensor.min_range = between(0, 2);
  sensor.height = between(0.2, 5);
  sensor.max_range = between(160, 300);
  sensor.range_sigma = between(0, 0.1);
  return sensor;
}

std::vector<Sensor> known_sensors_at_heights() {
  std::vector<Sensor> sensors;
  for (const Sensor& known : Sensor::known()) {
    for (const double height : {known.height, 0.2, 1.0, 2.0, 5.0}) {
      sensors.push_back(known);
      sensors.back().height = height;
    }
  }
  return sensors;
}

Segmentation segmented(const PatchworkConfig& config, const std::vector<Point>& points) {
  Patchwork patchwork(config);
  Segmentation result;
  EXPECT_TRUE(patchwork.segment(CloudView(&points.front().x, points.size()), result).ok());
  return result;
}

/// Number of beams that meet flat ground, per ring.
std::vector<int> beams_by_ring(const Sensor& sensor, const PatchworkConfig& config) {
  std::vector<int> beams;
  double inner = config.min_range;
  for (const Zone& zone : config.zones) {
    for (const float outer : zone.ring_radii) {
      beams.push_back(0);
      for (const double elevation : lines_of(sensor).elevations) {
        if (!meets_flat_ground(sensor, elevation)) continue;
        const double range = sensor.height / std::tan(-elevation * degree);
        beams.back() += range >= inner && range < outer;
      }
      inner = outer;
    }
  }
  return beams;
}

/// Number of bins in the rings that a beam meets on flat ground.
std::size_t bins_on_flat_ground(const Sensor& sensor, const PatchworkConfig& config) {
  const std::vector<int> beams = beams_by_ring(sensor, config);
  std::size_t ring = 0;
  std::size_t bins = 0;
  for (const Zone& zone : config.zones) {
    for (std::size_t i = 0; i < zone.ring_radii.size(); ++i, ++ring) {
      if (beams[ring] > 0) bins += static_cast<std::size_t>(zone.sectors);
    }
  }
  return bins;
}

/// The rings from the sensor to the last ring with a beam.
bool all_rings_have_a_beam(const Sensor& sensor, const PatchworkConfig& config) {
  std::vector<int> beams = beams_by_ring(sensor, config);
  while (!beams.empty() && beams.back() == 0) beams.pop_back();
  return !beams.empty() && std::ranges::count(beams, 0) == 0;
}

std::string refusal_of(const Sensor& sensor) {
  try {
    (void)PatchworkConfig::for_sensor(sensor);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PatchworkForSensor, IsValidForEveryKnownSensorAtAnyHeight) {
  for (const Sensor& sensor : known_sensors_at_heights()) {
    EXPECT_NO_THROW(PatchworkConfig::for_sensor(sensor).check())
        << sensor.name << " at " << sensor.height << " m";
  }
}

TEST(PatchworkForSensor, IsValidForAnySensorAndHasABeamInEveryRingOnFlatGround) {
  EXPECT_TRUE(rc::check([] {
    const Sensor sensor = any_sensor();
    const PatchworkConfig config = PatchworkConfig::for_sensor(sensor);
    config.check();
    RC_ASSERT(all_rings_have_a_beam(sensor, config));
  }));
}

TEST(PatchworkForSensor, BinsHaveEnoughPointsForAPlaneOnFlatGround) {
  for (const Sensor& sensor : known_sensors_at_heights()) {
    const PatchworkConfig config = PatchworkConfig::for_sensor(sensor);
    const Segmentation result = segmented(config, flat_scan(sensor));

    const auto full = std::ranges::count_if(
        result.patches(), [](const Patch& patch) { return patch.point_count >= fewest_points; });

    const std::size_t bins = bins_on_flat_ground(sensor, config);
    EXPECT_GE(static_cast<double>(full), (1 - share_with_fewer) * static_cast<double>(bins))
        << sensor.name << " at " << sensor.height << " m: " << bins << " bins";
  }
}

TEST(PatchworkForSensor, FlatGroundIsGround) {
  for (const Sensor& sensor : known_sensors_at_heights()) {
    const PatchworkConfig config = PatchworkConfig::for_sensor(sensor);
    const std::vector<Point> scan = flat_scan(sensor);
    const Segmentation result = segmented(config, scan);

    const std::size_t judged = scan.size() - result.count(Label::out_of_range);

    EXPECT_GE(static_cast<double>(result.count(Label::ground)), 0.99 * static_cast<double>(judged))
        << sensor.name << " at " << sensor.height << " m";
  }
}

TEST(PatchworkForSensor, ANarrowFieldOfViewHasNoBinsOutside) {
  for (const char* name : {"livox-avia", "at128"}) {
    const Sensor& sensor = Sensor::named(name);
    const PatchworkConfig narrow = PatchworkConfig::for_sensor(sensor);
    Sensor around = sensor;
    around.azimuth_begin = 0;
    around.azimuth_end = 360;
    around.firings =
        static_cast<int>(sensor.firings * 360 / (sensor.azimuth_end - sensor.azimuth_begin));

    const double share = static_cast<double>(bins_of(narrow)) /
                         static_cast<double>(bins_of(PatchworkConfig::for_sensor(around)));

    EXPECT_NEAR(narrow.field_of_view.begin, sensor.azimuth_begin, 1.001) << name;
    EXPECT_NEAR(share, (sensor.azimuth_end - sensor.azimuth_begin) / 360, 0.03) << name;
  }
}

TEST(PatchworkForSensor, OneTwoOrFourBeamsAreEnough) {
  Sensor sensor = Sensor::named("vlp-16");
  for (const std::vector<double>& beams :
       std::vector<std::vector<double>>{{-10}, {-5, -15}, {-3, -7, -11, -15}, {10, -10}}) {
    for (const double height : {0.2, 0.6, 2.0, 5.0}) {
      sensor.elevations = beams;
      sensor.height = height;
      const PatchworkConfig config = PatchworkConfig::for_sensor(sensor);
      EXPECT_NO_THROW(config.check());
      EXPECT_GE(segmented(config, flat_scan(sensor)).count(Label::ground), sensor.firings)
          << beams.size() << " beams at " << height << " m";
    }
  }
}

TEST(PatchworkForSensor, HasRingsForSlopedGroundBeyondTheLastBeam) {
  Sensor sensor = Sensor::named("vlp-16");
  const auto reach_of = [&] {
    return PatchworkConfig::for_sensor(sensor).zones.back().ring_radii.back();
  };

  EXPECT_GT(reach_of(), 0.8 * sensor.max_range);
  EXPECT_LE(reach_of(), sensor.max_range);

  sensor.elevations = {-30, -35, -40};
  EXPECT_LT(reach_of(), 2 * sensor.height / std::tan(30 * degree));
}

TEST(PatchworkForSensor, RingsScaleWithTheSensorHeight) {
  Sensor low = Sensor::named("hdl-64e");
  Sensor high = low;
  high.height = 2 * low.height;

  const PatchworkConfig of_low = PatchworkConfig::for_sensor(low);
  const PatchworkConfig of_high = PatchworkConfig::for_sensor(high);

  EXPECT_FLOAT_EQ(of_high.min_range, 2 * of_low.min_range);
  EXPECT_NEAR(of_high.zones[0].ring_radii[0], 2 * of_low.zones[0].ring_radii[0], 0.02);
  EXPECT_NEAR(of_high.elevation.range, 2 * of_low.elevation.range, 0.02);
}

TEST(PatchworkForSensor, ANarrowFieldOfViewIsOneDegreeWiderOnBothSides) {
  Sensor narrow = Sensor::named("hdl-64e");
  narrow.azimuth_begin = -45;
  narrow.azimuth_end = 45;

  const FieldOfView view = PatchworkConfig::for_sensor(narrow).field_of_view;

  EXPECT_EQ(view.begin, -46);
  EXPECT_EQ(view.width, 92);
}

TEST(PatchworkForSensor, RejectsASensorThatSeesNoGroundWithTheReason) {
  Sensor sensor = Sensor::named("vlp-16");
  sensor.elevations = {15, 0};
  EXPECT_THAT(refusal_of(sensor), HasSubstr("vlp-16: no beam meets flat ground"));

  sensor = Sensor::named("vlp-16");
  sensor.height = 0;
  EXPECT_THAT(refusal_of(sensor), HasSubstr("vlp-16: height = 0"));

  sensor.firings = 0;
  EXPECT_THAT(refusal_of(sensor), HasSubstr("firings = 0"));
}

}  // namespace
}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/concentric_zones.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "forced_target.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone::patchwork {
namespace {

std::uint32_t locate(const ConcentricZones& zones, Point p) {
  std::uint32_t bin = 0;
  zones.locate(&p.x, &p.y, &p.z, 1, &bin);
  return bin;
}

/// Zone, ring, sector and distance to the nearest bin boundary, computed directly from eq. (3).
struct Expected {
  std::uint32_t bin = 0;
  double to_boundary = 0;  ///< as a fraction of the range
};

constexpr double degree = std::numbers::pi / 180;

std::uint32_t bins_of(const PatchworkConfig& config) {
  std::size_t bins = 0;
  for (const Zone& zone : config.zones) {
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  return static_cast<std::uint32_t>(bins);
}

/// Angle from the start of the field of view to theta, counter-clockwise, 0 to 2 pi.
double from_begin(double theta, const FieldOfView& view) {
  const double turn = 2 * std::numbers::pi;
  const double angle = theta - view.begin * degree;
  return angle - turn * std::floor(angle / turn);
}

Expected by_equation(Point p, const PatchworkConfig& config) {
  const double rho = std::hypot(static_cast<double>(p.x), static_cast<double>(p.y));
  const double theta = std::atan2(static_cast<double>(p.y), static_cast<double>(p.x));
  Expected expected{0, std::abs(rho - config.min_range) / rho};
  double inner = config.min_range;
  for (const Zone& zone : config.zones) {
    for (const float outer : zone.ring_radii) {
      expected.to_boundary = std::min(expected.to_boundary, std::abs(rho - outer) / rho);
      if (rho >= inner && rho < outer) {
        const double width = config.field_of_view.width * degree;
        const double into_view = from_begin(theta, config.field_of_view);
        const double turn = into_view / width * zone.sectors;
        const double to_sector = std::abs(turn - std::round(turn)) * width / zone.sectors;
        expected.to_boundary = std::min(expected.to_boundary, to_sector);
        if (turn >= zone.sectors) break;
        expected.bin += static_cast<std::uint32_t>(turn);
        return expected;
      }
      inner = outer;
      expected.bin += static_cast<std::uint32_t>(zone.sectors);
    }
  }
  expected.bin = bins_of(config) + 1;  // out_of_range
  return expected;
}

/// Any number of zones, rings of any width, any number of sectors.
PatchworkConfig any_zones() {
  PatchworkConfig config;
  config.min_range = static_cast<float>(*rc::gen::inRange(0, 500)) / 100.0f;
  config.zones.clear();
  float radius = config.min_range;
  const int zones = *rc::gen::inRange(1, 7);
  for (int m = 0; m < zones; ++m) {
    Zone zone{.ring_radii = {}, .sectors = *rc::gen::inRange(1, 400), .height_margin = -1.1f};
    const int rings = *rc::gen::inRange(1, 12);
    for (int i = 0; i < rings; ++i) {
      radius += static_cast<float>(*rc::gen::inRange(1, 800)) / 100.0f;
      zone.ring_radii.push_back(radius);
    }
    config.zones.push_back(zone);
  }
  return config;
}

/// A field of view with any start and width; in one of four cases the full circle.
FieldOfView any_view() {
  const int choice = *rc::gen::inRange(0, 4);
  return {.begin = static_cast<float>(*rc::gen::inRange(-3600, 3601)) / 10.0f,
          .width = choice == 0 ? 360.0f : static_cast<float>(*rc::gen::inRange(1, 3600)) / 10.0f};
}

Point any_point(double reach) {
  const double range = reach * *rc::gen::inRange(0, 1000001) / 1000000.0;
  const double angle = std::numbers::pi * *rc::gen::inRange(-1000000, 1000001) / 1000000.0;
  return {static_cast<float>(range * std::cos(angle)), static_cast<float>(range * std::sin(angle)),
          -1.5f};
}

TEST(ConcentricZones, FindTheBinOfEquation3ForAnyZonesRingsAndSectors) {
  EXPECT_TRUE(rc::check([] {
    const PatchworkConfig config = any_zones();
    config.check();
    const ConcentricZones zones(config);
    for (int i = 0; i < 50; ++i) {
      const Point p = any_point(1.1 * config.zones.back().ring_radii.back());
      if (p.x == 0 && p.y == 0) continue;
      const Expected expected = by_equation(p, config);
      if (expected.to_boundary < 1e-6) continue;  // within rounding of a boundary
      const std::uint32_t bin = locate(zones, p);
      RC_ASSERT(bin == expected.bin || (bin == zones.out_of_range() && expected.bin == bin));
    }
  }));
}

TEST(ConcentricZones, FindTheBinInsideAnyFieldOfViewAndNoneOutside) {
  EXPECT_TRUE(rc::check([] {
    PatchworkConfig config = any_zones();
    config.field_of_view = any_view();
    config.check();
    const ConcentricZones zones(config);
    for (int i = 0; i < 50; ++i) {
      const Point p = any_point(1.1 * config.zones.back().ring_radii.back());
      if (p.x == 0 && p.y == 0) continue;
      const Expected expected = by_equation(p, config);
      if (expected.to_boundary < 2e-6) continue;  // within rounding of a boundary
      RC_ASSERT(locate(zones, p) == expected.bin);
    }
  }));
}

TEST(ConcentricZones, CountSectorsFromTheStartOfTheFieldOfView) {
  PatchworkConfig config;
  config.zones = {{.ring_radii = {10, 20}, .sectors = 4}};
  config.field_of_view = {.begin = 120, .width = 120};  // to the rear, across theta = pi
  const ConcentricZones zones(config);

  EXPECT_EQ(zones.bin_count(), 8U);
  EXPECT_EQ(locate(zones, {-3, 5, 0}), 0U);       // 121 degrees
  EXPECT_EQ(locate(zones, {-5, 0.1f, 0}), 1U);    // 179
  EXPECT_EQ(locate(zones, {-5, 0.0f, 0}), 2U);    // 180, a boundary
  EXPECT_EQ(locate(zones, {-5, -0.0f, 0}), 2U);   // -180
  EXPECT_EQ(locate(zones, {-5, -0.1f, 0}), 2U);   // 181
  EXPECT_EQ(locate(zones, {-15, -0.1f, 0}), 6U);  // in the second ring
  EXPECT_EQ(locate(zones, {-3, -5, 0}), 3U);      // 239
  for (const Point outside :
       {Point{-3, 5.5f, 0}, {-3, -5.5f, 0}, {5, 0, 0}, {0, 5, 0}, {0, -5, 0}}) {
    EXPECT_EQ(locate(zones, outside), zones.out_of_range()) << outside.x << ' ' << outside.y;
  }
}

TEST(ConcentricZones, AFullTurnFromAnyStartContainsAllPoints) {
  EXPECT_TRUE(rc::check([] {
    PatchworkConfig config;
    config.zones = {{.ring_radii = {80}, .sectors = *rc::gen::inRange(1, 3601)}};
    config.field_of_view.begin = static_cast<float>(*rc::gen::inRange(-360, 361));
    const ConcentricZones zones(config);
    // The start of the field of view, and the nearest numbers.
    const double begin = config.field_of_view.begin * degree;
    for (const double angle : {begin, begin - 1e-9, begin - 1e-7, begin + 1e-7}) {
      const Point p{static_cast<float>(10 * std::cos(angle)),
                    static_cast<float>(10 * std::sin(angle)), 0};
      RC_ASSERT(locate(zones, p) < zones.bin_count());
    }
  }));
}

TEST(ConcentricZones, PointsOnABoundaryOfThePaperBelongToTheBinBeyondIt) {
  const PatchworkConfig config = PatchworkConfig::preset("paper");
  const ConcentricZones zones(config);

  EXPECT_EQ(locate(zones, {-2.6999f, -0.001f, 0}), zones.out_of_range());
  EXPECT_EQ(locate(zones, {-2.7f, -1e-6f, 0}), 0u);
  EXPECT_EQ(locate(zones, {79.9999f, 0.001f, 0}) / 32, (zones.bin_count() - 1) / 32);
  EXPECT_EQ(locate(zones, {80.0f, 0, 0}), zones.out_of_range());
}

TEST(ConcentricZones, SectorsAreCountedFromMinusXCounterClockwise) {
  const ConcentricZones zones(PatchworkConfig::preset("paper"));  // 16 sectors in Z_1

  EXPECT_EQ(locate(zones, {-5, -0.1f, 0}), 0u);  // theta just above -pi
  EXPECT_EQ(locate(zones, {0, -5, 0}), 4u);      // -pi / 2, a boundary, belongs to the next sector
  EXPECT_EQ(locate(zones, {5, -0.1f, 0}), 7u);
  EXPECT_EQ(locate(zones, {5, 0, 0}), 8u);   // 0
  EXPECT_EQ(locate(zones, {0, 5, 0}), 12u);  // pi / 2
  EXPECT_EQ(locate(zones, {-5, 0.1f, 0}), 15u);
}

TEST(ConcentricZones, ThetaOfPiIsThetaOfMinusPi) {
  const ConcentricZones zones(PatchworkConfig::preset("paper"));

  EXPECT_EQ(locate(zones, {-5, 0.0f, 0}), 0u);
  EXPECT_EQ(locate(zones, {-5, -0.0f, 0}), 0u);
}

TEST(ConcentricZones, CoordinatesOfAnyValueGetAValidBin) {
  const ConcentricZones zones{PatchworkConfig()};
  PatchworkConfig rear;
  rear.field_of_view = {.begin = 90, .width = 180};
  const ConcentricZones rear_zones(rear);
  EXPECT_TRUE(rc::check([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const Point p{std::bit_cast<float>(x), std::bit_cast<float>(y), std::bit_cast<float>(z)};
    RC_ASSERT(locate(zones, p) <= zones.invalid());
    RC_ASSERT(locate(rear_zones, p) <= rear_zones.invalid());
  }));
}

TEST(ConcentricZones, AZoneFromTheOriginHasABinForPointsAboveIt) {
  PatchworkConfig config;
  config.min_range = 0;
  const ConcentricZones zones(config);

  EXPECT_LT(locate(zones, {0, 0, -1}), zones.bin_count());
  EXPECT_LT(locate(zones, {1e-40f, -1e-40f, -1}), zones.bin_count());
}

TEST(ConcentricZones, TheNoiseLimitDecreasesWithRangeIfTheGroundMaySlopeDown) {
  PatchworkConfig config;
  config.sensor_height = 1;
  config.noise_depth = 2;
  config.noise_slope = 0.5f;
  config.zones = {{.ring_radii = {10, 20}, .sectors = 4, .height_margin = -1.1f}};
  const ConcentricZones zones(config);

  EXPECT_LT(locate(zones, {9, 0, -7.9f}), zones.bin_count());
  EXPECT_EQ(locate(zones, {9, 0, -8.1f}), zones.noise());
  EXPECT_LT(locate(zones, {11, 0, -12.9f}), zones.bin_count());
  EXPECT_EQ(locate(zones, {11, 0, -13.1f}), zones.noise());
}

TEST(ConcentricZones, PointsOnADiagonalAreInTheSectorThatBeginsThere) {
  // Sectors are counted from theta = -pi; of 16 sectors, every second one begins on an axis or a
  // diagonal.
  PatchworkConfig config;
  config.zones = {{.ring_radii = {80}, .sectors = 16}};
  const ConcentricZones zones(config);
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    for (const float a : {2.0f, 2.7f, 5.5f, 7.1234f, 13.266f, 55.0f}) {
      EXPECT_EQ(locate(zones, {-a, -a, 0}), 2U) << a << " on " << target;
      EXPECT_EQ(locate(zones, {a, -a, 0}), 6U) << a << " on " << target;
      EXPECT_EQ(locate(zones, {a, a, 0}), 10U) << a << " on " << target;
      EXPECT_EQ(locate(zones, {-a, a, 0}), 14U) << a << " on " << target;
    }
  }
}

TEST(ConcentricZones, PointsAtInfinityAreOutOfRangeForAnyNumberOfRings) {
  // The squared range is infinite, and the number of rings is not a power of two.
  for (const int rings : {1, 15, 16, 17, 33, 600, 1000}) {
    PatchworkConfig config;
    config.zones = {{.ring_radii = equal_rings(config.min_range, 80, rings), .sectors = 2}};
    const ConcentricZones zones(config);
    for (const std::string& target : simd_targets()) {
      const tests::ForcedTarget forced(target);
      EXPECT_EQ(locate(zones, {1e20f, 1, 0}), zones.out_of_range()) << rings << " on " << target;
      EXPECT_EQ(locate(zones, {3e38f, -3e38f, 0}), zones.out_of_range());
      EXPECT_EQ(locate(zones, {79, -79, 0}), zones.out_of_range());
      EXPECT_EQ(locate(zones, {std::numeric_limits<float>::infinity(), 1, 0}), zones.invalid());
    }
  }
}

}  // namespace
}  // namespace flagstone::patchwork

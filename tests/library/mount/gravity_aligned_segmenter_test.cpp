// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Also counts allocations: counted_allocation.cpp replaces operator new.
#include "flagstone/gravity_aligned_segmenter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "counted_allocation.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "library/mount/recording_method.hpp"
#include "library/mount/yard.hpp"
#include "numbers.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::RecordingMethod;
using tests::scan_of;
using tests::view_of;
using tests::Yard;
using tests::YardScan;

/// A general mounting pose: tilted, in millimetres, away from the origin of the frame, higher than
/// configured in the method.
MountSettings odd_mount() {
  MountSettings settings{.tilt = TiltSource::fixed};
  settings.mount = {.sensor_height = 2.5f,
                    .up = {0.3f, -0.2f, 0.9f},
                    .origin = {1.5f, -0.5f, 0.25f},
                    .scale = 0.001f};
  return settings;
}

/// The expected position of a point in the level frame, in double precision.
std::array<double, 3> level_place(const Point& p, const Mount& mount) {
  const std::array<double, 3> q = {double{mount.scale} * p.x - mount.origin[0],
                                   double{mount.scale} * p.y - mount.origin[1],
                                   double{mount.scale} * p.z - mount.origin[2]};
  const auto& u = mount.up;
  const double length = std::sqrt(double{u[0]} * u[0] + double{u[1]} * u[1] + double{u[2]} * u[2]);
  const std::array<double, 3> up = {u[0] / length, u[1] / length, u[2] / length};
  // Rodrigues' formula: rotation about up x z by the angle between them.
  const std::array<double, 2> axis = {up[1], -up[0]};
  const double dot = axis[0] * q[0] + axis[1] * q[1];
  const double k = dot / (1 + up[2]);
  return {q[0] * up[2] + axis[1] * q[2] + k * axis[0], q[1] * up[2] - axis[0] * q[2] + k * axis[1],
          q[2] * up[2] + axis[0] * q[1] - axis[1] * q[0]};
}

std::vector<Label> labels_of(const Segmentation& result) {
  return {result.labels().begin(), result.labels().end()};
}

TEST(GravityAlignedSegmenter, PassesTheCloudItselfIfNoTransformIsNeeded) {
  RecordingMethod::Seen seen;
  GravityAlignedSegmenter levelled(std::make_unique<RecordingMethod>(seen), 1.73f, {});
  const std::vector<Point> cloud = corrupted_cloud(500, 1);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  EXPECT_EQ(seen.view.data(), cloud.data());
  EXPECT_EQ(levelled.decision().verdict, MountVerdict::fixed);
}

TEST(GravityAlignedSegmenter, ReturnsTheResultOfTheMethodIfNoTransformIsNeeded) {
  Surface method;
  GravityAlignedSegmenter levelled(std::make_unique<Surface>(), 1.73f, {});
  const std::vector<Point> cloud = corrupted_cloud(20000, 2);
  Segmentation expected;
  Segmentation result;
  ASSERT_TRUE(method.segment(view_of(cloud), expected).ok());

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  EXPECT_EQ(labels_of(result), labels_of(expected));
  EXPECT_EQ(result.patches().size(), expected.patches().size());
  EXPECT_EQ(result.surface().height(5, 5), expected.surface().height(5, 5));
}

TEST(GravityAlignedSegmenter, PassesMetresFromTheSensorWithGroundAtTheExpectedHeight) {
  RecordingMethod::Seen seen;
  const MountSettings settings = odd_mount();
  GravityAlignedSegmenter levelled(std::make_unique<RecordingMethod>(seen), 1.73f, settings);
  std::vector<Point> cloud = random_cloud(2000, 1);
  for (Point& p : cloud) p = {1000 * p.x, 1000 * p.y, 1000 * p.z};
  Segmentation result;

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  ASSERT_EQ(seen.points.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto place = level_place(cloud[i], settings.mount);
    ASSERT_NEAR(seen.points[i].x, place[0], 1e-4);
    ASSERT_NEAR(seen.points[i].y, place[1], 1e-4);
    ASSERT_NEAR(seen.points[i].z, place[2] + 2.5 - 1.73, 1e-4);
  }
}

TEST(GravityAlignedSegmenter, PassesTheSamePointsForEveryLayout) {
  const std::vector<Point> cloud = corrupted_cloud(1001, 4);
  for (const std::size_t floats : {3U, 4U, 5U, 7U}) {
    std::vector<float> memory(floats * cloud.size(), -1);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      memory[floats * i] = cloud[i].x;
      memory[floats * i + 1] = cloud[i].y;
      memory[floats * i + 2] = cloud[i].z;
    }
    std::vector<std::byte> odd(memory.size() * sizeof(float) + 1);  // misaligns every float
    std::memcpy(odd.data() + 1, memory.data(), memory.size() * sizeof(float));
    const auto stride = static_cast<std::ptrdiff_t>(floats * sizeof(float));
    RecordingMethod::Seen aligned;
    RecordingMethod::Seen unaligned;
    GravityAlignedSegmenter first(std::make_unique<RecordingMethod>(aligned), 1.73f, odd_mount());
    GravityAlignedSegmenter second(std::make_unique<RecordingMethod>(unaligned), 1.73f,
                                   odd_mount());
    Segmentation result;

    ASSERT_TRUE(first.segment(CloudView(memory.data(), cloud.size(), floats), result).ok());
    ASSERT_TRUE(
        second.segment(CloudView(odd.data() + 1, cloud.size(), {stride, 0, 4, 8}), result).ok());

    EXPECT_EQ(0, std::memcmp(aligned.points.data(), unaligned.points.data(),
                             cloud.size() * sizeof(Point)))
        << floats;
  }
}

TEST(GravityAlignedSegmenter, KeepsZeroAndNonFinitePointsAndCreatesNoOthers) {
  const MountSettings settings = odd_mount();
  std::vector<Point> cloud = corrupted_cloud(5000, 5);
  cloud.insert(cloud.end(), {{0, 0, 0},
                             {-0.0f, 0, 0},
                             {nan, 1, 1},
                             {1, inf, 1},
                             {1, 1, -inf},
                             {3e38f, -3e38f, 3e38f},
                             {1500, -500, 250}});  // the position of the sensor
  RecordingMethod::Seen seen;
  GravityAlignedSegmenter levelled(std::make_unique<RecordingMethod>(seen), 2.5f, settings);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  const auto is_finite = [](const Point& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  const auto is_zero = [](const Point& p) { return p.x == 0 && p.y == 0 && p.z == 0; };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(is_finite(seen.points[i]), is_finite(cloud[i])) << i;
    const bool is_denormal = std::max({std::abs(cloud[i].x), std::abs(cloud[i].y),
                                       std::abs(cloud[i].z)}) < std::numeric_limits<float>::min();
    if (!is_denormal) {
      ASSERT_EQ(is_zero(seen.points[i]), is_zero(cloud[i])) << i;
    }
  }
}

TEST(GravityAlignedSegmenter, LabelsInvalidPointsInvalidForEveryMountingPose) {
  std::vector<Point> cloud = random_cloud(5000, 6);
  cloud[10] = {0, 0, 0};
  cloud[20] = {1, nan, 0};
  MountSettings settings = odd_mount();
  settings.mount.scale = 1;
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f, settings);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  EXPECT_EQ(result.labels()[10], Label::invalid);
  EXPECT_EQ(result.labels()[20], Label::invalid);
  EXPECT_EQ(result.count(Label::invalid), 2U);
}

/// Compares the labels and heights of a tilted sensor with the ground truth of the yard.
TEST(GravityAlignedSegmenter, ATiltedSensorFindsTheGroundOfALevelSensor) {
  const std::vector<sim::Box> boxes = {{.low = {-20, 5, -1}, .high = {20, 6, 6}},
                                       {.low = {6, -4, 0}, .high = {10, -2, 2}}};
  const YardScan scan =
      scan_of({.boxes = boxes, .mounting = {.height = 1.73, .pitch = 15, .roll = 10}});
  MountSettings estimate{.height = HeightSource::estimate, .tilt = TiltSource::estimate};
  GravityAlignedSegmenter levelled(std::make_unique<Surface>(), 1.73f, estimate);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(scan.view(), result).ok());

  std::size_t wrong = 0;
  std::size_t judged = 0;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double height = level_place(scan.points[i], scan.mount)[2] + 1.73;
    const bool is_clear = std::abs(height) < 0.1 || height > 0.4;
    if (!is_clear || result.labels()[i] == Label::out_of_range) continue;
    ++judged;
    wrong += (result.labels()[i] == Label::ground) != (height < 0.2) ? 1U : 0U;
    if (std::isfinite(result.heights()[i]) && height < 0.1) {
      ASSERT_NEAR(result.heights()[i], height, 0.15) << i;
    }
  }
  EXPECT_GT(judged, 20000U);
  EXPECT_LT(static_cast<double>(wrong), 0.01 * static_cast<double>(judged));
}

TEST(GravityAlignedSegmenter, PatchesAreInTheFrameAndUnitsOfTheCloud) {
  YardScan scan = scan_of({.mounting = {.height = 2.2, .pitch = 20}});
  MountSettings settings{.tilt = TiltSource::fixed, .mount = scan.mount};
  settings.mount.scale = 0.001f;
  settings.mount.origin = {0.4f, -0.3f, 1};
  for (Point& p : scan.points) {
    p = {1000 * (p.x + 0.4f), 1000 * (p.y - 0.3f), 1000 * (p.z + 1)};
  }
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f, settings);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(scan.view(), result).ok());

  std::size_t planes = 0;
  for (const Patch& patch : result.patches()) {
    if (!patch.is_ground() || patch.verdict != Verdict::ground) continue;
    ++planes;
    const auto& n = patch.normal;
    const auto& m = patch.mean;
    ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-4);
    // The mean is in the plane, and both are on the ground, 2.2 m below the sensor, in millimetres.
    ASSERT_NEAR(n[0] * m[0] + n[1] * m[1] + n[2] * m[2] + patch.d, 0, 5);
    const auto place = level_place({m[0], m[1], m[2]}, settings.mount);
    ASSERT_NEAR(place[2], -2.2, 0.1);
    ASSERT_LT(tests::degrees_between(n, scan.mount.up), 10);
  }
  EXPECT_GT(planes, 20U);
}

TEST(GravityAlignedSegmenter, RestoresThePatchesOfAShiftedCloudExactly) {
  MountSettings settings;
  settings.mount.sensor_height = 2.23f;
  std::vector<Point> cloud = random_cloud(20000, 7);
  std::vector<Point> lifted = cloud;
  for (Point& p : lifted) p.z += 0.5f;
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f, settings);
  Patchwork method;
  Segmentation expected;
  Segmentation result;
  ASSERT_TRUE(method.segment(view_of(lifted), expected).ok());

  ASSERT_TRUE(levelled.segment(view_of(cloud), result).ok());

  ASSERT_EQ(labels_of(result), labels_of(expected));
  for (std::size_t i = 0; i < expected.patches().size(); ++i) {
    const Patch& ours = result.patches()[i];
    const Patch& theirs = expected.patches()[i];
    EXPECT_EQ(ours.verdict, theirs.verdict);
    EXPECT_EQ(ours.normal, theirs.normal);
    if (theirs.normal[2] == 0) continue;
    EXPECT_NEAR(ours.mean[2], theirs.mean[2] - 0.5f, 1e-5f);
    EXPECT_NEAR(ours.d, theirs.d + 0.5f * theirs.normal[2], 1e-5f);
  }
}

TEST(GravityAlignedSegmenter, TheSurfaceIsRelativeToTheSensorAndHeightsToTheGround) {
  const YardScan scan = scan_of({.mounting = {.height = 2.6}});
  MountSettings settings;
  settings.mount.sensor_height = 2.6f;
  GravityAlignedSegmenter levelled(std::make_unique<Surface>(), 1.73f, settings);
  Segmentation result;

  ASSERT_TRUE(levelled.segment(scan.view(), result).ok());

  EXPECT_NEAR(result.surface().height(8, 2), -2.6f, 0.03f);
  EXPECT_NEAR(result.surface().height(-5, 7), -2.6f, 0.03f);
  for (std::size_t i = 0; i < scan.points.size(); i += 97) {
    if (std::isnan(result.heights()[i])) continue;
    EXPECT_NEAR(result.heights()[i],
                scan.points[i].z - result.surface().height(scan.points[i].x, scan.points[i].y),
                1e-4f);
  }
}

TEST(GravityAlignedSegmenter, LetsTheMethodRejectAnInvalidCloud) {
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f, odd_mount());
  Segmentation result;

  const Status status = levelled.segment(CloudView(nullptr, 5), result);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_TRUE(result.labels().empty());
}

TEST(GravityAlignedSegmenter, SegmentsAnEmptyCloud) {
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f,
                                   {.height = HeightSource::track, .tilt = TiltSource::estimate});
  Segmentation result;

  EXPECT_TRUE(levelled.segment(CloudView(), result).ok());
  EXPECT_EQ(levelled.decision().verdict, MountVerdict::too_few_points);
}

TEST(GravityAlignedSegmenter, RejectsANullMethodAndSettingsOutOfRange) {
  RecordingMethod::Seen seen;
  MountSettings flat;
  flat.mount.up = {0, 0, 0};

  EXPECT_THROW(GravityAlignedSegmenter(nullptr, 1.73f, {}), std::invalid_argument);
  EXPECT_THROW(GravityAlignedSegmenter(std::make_unique<RecordingMethod>(seen), nan, {}),
               std::invalid_argument);
  EXPECT_THROW(GravityAlignedSegmenter(std::make_unique<RecordingMethod>(seen), 1.73f, flat),
               std::invalid_argument);
}

TEST(GravityAlignedSegmenter, AllocatesNothingAfterTheFirstScan) {
  const YardScan scan = scan_of({.sensor = "vlp-16", .mounting = {.height = 1.73, .pitch = 8}});
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f,
                                   {.height = HeightSource::track, .tilt = TiltSource::estimate});
  Segmentation result;
  ASSERT_TRUE(levelled.segment(scan.view(), result).ok());
  io::allocated = 0;

  for (int repeat = 0; repeat < 3; ++repeat) {
    ASSERT_TRUE(levelled.segment(scan.view(), result).ok());
  }

  EXPECT_EQ(io::allocated, 0U);
}

TEST(GravityAlignedSegmenter, FailsWithoutMemoryAndRecovers) {
  const std::vector<Point> cloud = random_cloud(50000, 8);
  GravityAlignedSegmenter levelled(std::make_unique<Patchwork>(), 1.73f, odd_mount());
  Segmentation result;
  io::allocated = 0;
  io::allowed = 100;

  const Status status = levelled.segment(view_of(cloud), result);
  io::allowed = io::unlimited;

  EXPECT_EQ(status.code(), StatusCode::out_of_memory);
  EXPECT_TRUE(result.labels().empty());
  EXPECT_TRUE(levelled.segment(view_of(cloud), result).ok());
}

TEST(GravityAlignedSegmenter, SegmentsAfterAMove) {
  RecordingMethod::Seen seen;
  GravityAlignedSegmenter original(std::make_unique<RecordingMethod>(seen), 1.73f, odd_mount());
  GravityAlignedSegmenter moved = std::move(original);
  Segmentation result;

  EXPECT_TRUE(moved.segment(view_of(random_cloud(10, 1)), result).ok());
  EXPECT_EQ(moved.settings().mount.sensor_height, 2.5f);
}

}  // namespace
}  // namespace flagstone

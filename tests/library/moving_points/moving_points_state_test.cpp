// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/moving_points.hpp"
#include "library/ground_map/state_checks.hpp"
#include "library/moving_points/box_scene.hpp"

namespace flagstone {
namespace {

using testing::HasSubstr;

/// The scans of a sensor that passes a parked car, a house and a moving car, five per second.
class Run {
 public:
  static constexpr std::size_t scans = 20;

  Run() {
    for (std::size_t k = 0; k < scans; ++k) {
      poses_.push_back(sensor_at(6 * time(k), 0));
      scans_.emplace_back(
          std::vector<Box>{{.x = 45 - 8 * time(k), .y = 4},
                           {.x = 25, .y = -4},
                           {.x = 30, .y = 12, .length = 30, .width = 4, .height = 8}},
          poses_.back());
    }
  }

  static double time(std::size_t k) { return 0.2 * static_cast<double>(k); }

  /// The mask of scan k after it is added, or found again.
  std::vector<std::uint32_t> add(MovingPoints& moving, std::size_t k) const {
    MovingMask mask;
    EXPECT_TRUE(
        moving.add(scans_[k].view(), scans_[k].result, poses_[k], levelling, time(k), mask).ok());
    return mask.objects_of_points;
  }
  std::vector<std::uint32_t> find(MovingPoints& moving, std::size_t k) const {
    MovingMask mask;
    EXPECT_TRUE(
        moving.find(scans_[k].view(), scans_[k].result, poses_[k], levelling, time(k), mask).ok());
    return mask.objects_of_points;
  }

 private:
  static constexpr Levelling levelling{
      .applied = true, .cells = 900, .offset = 0.02, .slope_x = 0.001, .slope_y = -0.002};

  std::vector<Pose> poses_;
  std::vector<BoxScan> scans_;
};

const Run& run() {
  static const Run run;
  return run;
}

MovingPoints after(std::size_t scans, const MovingPointsConfig& config = {}) {
  MovingPoints moving(config);
  for (std::size_t k = 0; k < scans; ++k) run().add(moving, k);
  return moving;
}

TEST(MovingPointsState, IsTheSameAfterARoundTrip) {
  for (const std::size_t scans : {0U, 1U, 4U}) {
    const MovingPoints moving = after(scans);
    const Bytes bytes = bytes_of(moving);
    MovingPoints copy;

    ASSERT_TRUE(copy.from_bytes(bytes).ok());

    EXPECT_EQ(bytes_of(copy), bytes);
    EXPECT_EQ(copy.scans(), scans);
    EXPECT_EQ(copy.beam_spacing(), moving.beam_spacing());
  }
}

TEST(MovingPointsState, CallsAfterLoadingGiveTheResultsWithoutABreak) {
  const MovingPointsConfig config{.delay = 1, .window = 100};
  MovingPoints whole = after(12, config);
  MovingPoints loaded(config);
  ASSERT_TRUE(loaded.from_bytes(bytes_of(whole)).ok());
  std::size_t moving_points = 0;
  for (std::size_t k = 12; k < Run::scans; ++k) {
    EXPECT_EQ(run().add(loaded, k), run().add(whole, k));
    const std::vector<std::uint32_t> mask = run().find(whole, k - 5);
    EXPECT_EQ(run().find(loaded, k - 5), mask);
    moving_points += static_cast<std::size_t>(std::ranges::count(mask, 1U));
  }
  EXPECT_GT(moving_points, 0U);
  EXPECT_EQ(bytes_of(loaded), bytes_of(whole));
}

TEST(MovingPointsState, IsRejectedIfTruncatedOrDamagedAnywhere) {
  MovingPoints loaded = after(1);
  expect_damage_is_rejected(bytes_of(after(2)), loaded);
}

TEST(MovingPointsState, WithAnyNumberChangedIsRejectedOrLoadedAsItIs) {
  expect_changes_are_rejected_or_kept<MovingPoints>(
      bytes_of(after(2)), 500, [](MovingPoints& moving) { run().add(moving, 3); });
}

TEST(MovingPointsState, ReportsAnotherVersionOrKind) {
  MovingPoints moving;
  Bytes bytes = bytes_of(moving);
  bytes[7] = std::byte{'9'};
  EXPECT_THAT(moving.from_bytes(sealed(bytes)).message(), HasSubstr("another version"));
  bytes[3] = std::byte{'x'};
  EXPECT_THAT(moving.from_bytes(sealed(bytes)).message(), HasSubstr("byte 0: not the"));
}

TEST(MovingPointsState, IsRejectedIfTheBeamSpacingDiffers) {
  const Bytes bytes = bytes_of(after(1, {.beam_spacing = 1}));
  MovingPoints other({.beam_spacing = 2});
  EXPECT_THAT(other.from_bytes(bytes).message(), HasSubstr("the beam spacing differs"));
  MovingPoints same({.beam_spacing = 1});
  EXPECT_TRUE(same.from_bytes(bytes).ok());
  MovingPoints measured;
  EXPECT_TRUE(measured.from_bytes(bytes).ok());
  EXPECT_NEAR(measured.beam_spacing(), 1, 1e-6);
}

}  // namespace
}  // namespace flagstone

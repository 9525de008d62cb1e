// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/pose_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flagstone::sim {
namespace {

// Straight along x, 1 m apart.
std::vector<Frame> straight_run(std::size_t poses) {
  std::vector<Frame> run;
  for (std::size_t i = 0; i < poses; ++i) {
    run.push_back(upright_frame({static_cast<double>(i), 0, 1.7}, 0));
  }
  return run;
}

bool is_orthonormal(const Frame& frame) {
  return length(cross(frame.forward, frame.left) - frame.up) < 1e-9 &&
         std::abs(length(frame.forward) - 1) < 1e-9 && std::abs(length(frame.up) - 1) < 1e-9;
}

TEST(PoseNoise, NoneKeepsThePoses) {
  const std::vector<Frame> exact = straight_run(20);

  const std::vector<Frame> measured = measured_poses(exact, *find_pose_noise("none"), 1);

  ASSERT_EQ(measured.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LT(length(measured[i].origin - exact[i].origin), 1e-9);
    EXPECT_LT(length(measured[i].forward - exact[i].forward), 1e-9);
  }
}

TEST(PoseNoise, JitterIsIndependentOfTheDistance) {
  constexpr std::size_t poses = 2000;
  const std::vector<Frame> exact = straight_run(poses);
  const std::vector<Frame> measured = measured_poses(exact, *find_pose_noise("jitter"), 1);

  double squared_z = 0;
  double squared_pitch = 0;
  for (std::size_t i = 0; i < poses; ++i) {
    ASSERT_TRUE(is_orthonormal(measured[i]));
    const double z = measured[i].origin.z - exact[i].origin.z;
    squared_z += z * z;
    squared_pitch += measured[i].forward.z * measured[i].forward.z;
  }
  EXPECT_NEAR(std::sqrt(squared_z / poses), 0.02, 0.002);
  const double degrees = std::sqrt(squared_pitch / poses) * 180 / std::numbers::pi;
  EXPECT_NEAR(degrees, 0.2, 0.02);
}

TEST(PoseNoise, DriftGrowsWithTheDistance) {
  const std::vector<Frame> exact = straight_run(101);
  const std::vector<Frame> measured = measured_poses(exact, *find_pose_noise("drift"), 1);

  EXPECT_LT(length(measured[0].origin - exact[0].origin), 1e-9);
  EXPECT_NEAR(std::abs(measured[100].origin.z - exact[100].origin.z), 1, 0.01);
  const double yaw = std::atan2(measured[100].forward.y, measured[100].forward.x);
  EXPECT_NEAR(std::abs(yaw) * 180 / std::numbers::pi, 1, 0.01);
  for (const Frame& pose : measured) ASSERT_TRUE(is_orthonormal(pose));
}

TEST(PoseNoise, DependsOnTheSeedOnly) {
  const std::vector<Frame> exact = straight_run(5);
  const PoseNoise& noise = *find_pose_noise("jitter");

  EXPECT_EQ(measured_poses(exact, noise, 1)[3].origin, measured_poses(exact, noise, 1)[3].origin);
  EXPECT_NE(measured_poses(exact, noise, 1)[3].origin, measured_poses(exact, noise, 2)[3].origin);
}

}  // namespace
}  // namespace flagstone::sim

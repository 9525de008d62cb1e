// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/map_outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

TEST(MapOutputs, MovingPointsAreReadBack) {
  const io::TemporaryFolder folder;
  const MovingMask written{.objects_of_points = {0, 2, 1, 0, 70000}, .objects = {{}, {}}};
  ASSERT_TRUE(write_moving(folder / "a.moving.npy", written).ok());
  MovingMask read;
  ASSERT_TRUE(read_moving(folder / "a.moving.npy", 5, read).ok());
  EXPECT_EQ(read.objects_of_points, (std::vector<std::uint32_t>{0, 2, 1, 0, 65535}));
  EXPECT_FALSE(read_moving(folder / "a.moving.npy", 6, read).ok());
  EXPECT_EQ(read_moving(folder / "b.moving.npy", 5, read).code(), StatusCode::not_found);
}

TEST(MapOutputs, ALevelledPoseFitsTheMap) {
  // The scan measures a slope of 3 cm/m along x and is 0.2 m too high.
  const Levelling levelling{.applied = true, .cells = 500, .offset = 0.2, .slope_x = 0.03};
  const Pose pose = levelled({.position = {5, 6, 7}}, levelling);
  EXPECT_NEAR(pose.position[2], 6.8, 1e-12);
  // A point 10 m ahead comes down by 0.3 m, and one to the left stays.
  const auto z_of = [&](double x, double y, double z) {
    return pose.rotation[6] * x + pose.rotation[7] * y + pose.rotation[8] * z;
  };
  EXPECT_NEAR(z_of(10, 0, 0), -0.3, 1e-3);
  EXPECT_NEAR(z_of(0, 10, 0), 0, 1e-12);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto& r = pose.rotation;
    EXPECT_NEAR(std::hypot(r[3 * row], r[3 * row + 1], r[3 * row + 2]), 1, 1e-12);
  }
}

TEST(MapOutputs, ObjectsAreLinesOfATable) {
  const io::TemporaryFolder folder;
  ObjectTable table;
  const std::vector<MovingObject> objects{
      {.points = 12, .confidence = 0.75F, .min = {1, 2, -1}, .max = {3, 4, 0.5F}}};
  table.add("000003", objects);
  ASSERT_TRUE(table.write(folder / "objects.csv").ok());
  EXPECT_EQ(io::contents_of(folder / "objects.csv"),
            "scan,object,points,confidence,min_x,min_y,min_z,max_x,max_y,max_z\n"
            "000003,1,12,0.750,1.00,2.00,-1.00,3.00,4.00,0.50\n");
}

TEST(MapOutputs, PosesAreWrittenInKittiFormat) {
  const io::TemporaryFolder folder;
  const std::vector<Pose> poses{{.position = {1.5, -2, 0.25}}};
  ASSERT_TRUE(write_kitti_poses(folder / "poses.txt", poses).ok());
  EXPECT_EQ(io::contents_of(folder / "poses.txt"), "1 0 0 1.5 0 1 0 -2 0 0 1 0.25\n");
}

}  // namespace
}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/static_cloud.hpp"

#include <gtest/gtest.h>

#include "files/io/read_cloud.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

TEST(StaticCloud, KeepsTheFirstPointOfEachVoxel) {
  StaticCloud cloud(0.5);
  cloud.add({{.x = 0.1, .y = 0.1, .z = 0.1, .height = 1},
             {.x = 0.4, .y = 0.4, .z = 0.4, .height = 2},
             {.x = -0.1, .y = 0.1, .z = 0.1, .height = 3}});
  cloud.add({{.x = 0.2, .y = 0.2, .z = 0.2, .height = 4}});
  EXPECT_EQ(cloud.size(), 2U);
}

TEST(StaticCloud, IsWrittenWithHeightsAndLabels) {
  const io::TemporaryFolder folder;
  StaticCloud cloud(0.5);
  cloud.add({{.x = 500000.25, .y = -7, .z = 3, .height = 1.5F, .label = Label::ground}});
  ASSERT_TRUE(cloud.write(folder / "static.ply").ok());
  io::Cloud read;
  ASSERT_TRUE(io::read_cloud(folder / "static.ply", {}, read).ok());
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read.value(0, *read.find("x")), 500000.25);
  EXPECT_EQ(read.value(0, *read.find("height")), 1.5);
  EXPECT_EQ(read.value(0, *read.find("label")), 1);
}

TEST(StaticCloud, MayBeEmpty) {
  const io::TemporaryFolder folder;
  EXPECT_TRUE(StaticCloud(0.2).write(folder / "static.ply").ok());
}

}  // namespace
}  // namespace flagstone::app

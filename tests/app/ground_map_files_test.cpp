// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/ground_map_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/npy.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/ground_map.hpp"
#include "library/ground_map/ground_scan.hpp"

namespace flagstone::app {
namespace {

using cli::names_below;
using nlohmann::json;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;

double sloping_ground(double x, double y) { return 5 + 0.05 * x - 0.02 * y; }

/// A map of two scans that cross the origin.
GroundMap mapped() {
  GroundMap map;
  for (const double x : {-3.0, 4.0}) {
    const Pose pose = upright_pose(sloping_ground, x, 1);
    const GroundScan scan(sloping_ground, pose, 20);
    Levelling levelling;
    EXPECT_TRUE(map.add(scan.view(), scan.result, pose, levelling).ok());
  }
  return map;
}

class GroundMapFilesTest : public testing::Test {
 protected:
  void write() {
    const Status status = files_.write(map_);
    ASSERT_TRUE(status.ok()) << status.message();
    geometry_ = json::parse(io::contents_of(files_.geometry()));
  }

  io::TemporaryFolder folder_;
  GroundMap map_ = mapped();
  GroundMapFiles files_{.directory = folder_ / "ground"};
  json geometry_;
};

TEST_F(GroundMapFilesTest, AreOnePerTileAndTheirGeometry) {
  write();

  EXPECT_THAT(names_below(folder_ / "ground"),
              ElementsAre("-1_-1.npy", "-1_0.npy", "0_-1.npy", "0_0.npy", "map.json"));
}

TEST_F(GroundMapFilesTest, ContainEveryCellWithItsFields) {
  write();
  const auto tile = std::make_unique<MapTile>();
  for (const TileIndex index : map_.tiles()) {
    ASSERT_TRUE(map_.read_tile(index, *tile));
    const std::string file = io::contents_of(files_.tile(index));
    io::NpyHeader header;
    ASSERT_TRUE(io::read_npy_header(file, header).ok());
    EXPECT_THAT(header.shape, ElementsAre(64, 64));
    ASSERT_EQ(header.fields.size(), 5U);
    ASSERT_EQ(file.size(), header.size + MapTile::cells * 16);
    for (std::size_t k = 0; k < MapTile::cells; ++k) {
      const char* const record = file.data() + header.size + 16 * k;
      const auto same = [&](std::size_t offset, const auto& value) {
        return std::memcmp(record + offset, &value, sizeof(value)) == 0;
      };
      EXPECT_TRUE(same(0, tile->height[k]) && same(4, tile->deviation[k]) &&
                  same(8, tile->last_scan[k]) && same(12, tile->scans[k]) &&
                  same(14, tile->contradictions[k]))
          << files_.tile(index) << " cell " << k;
    }
  }
}

TEST_F(GroundMapFilesTest, DescribeFrameUnitsAndLayers) {
  write();

  EXPECT_EQ(geometry_["format"], "flagstone ground map");
  EXPECT_EQ(geometry_["version"], 1);
  EXPECT_EQ(geometry_["units"], "metres");
  EXPECT_EQ(geometry_["cell"], 0.5);
  EXPECT_EQ(geometry_["tile_width"], 64);
  EXPECT_EQ(geometry_["scans"], 2);
  EXPECT_EQ(geometry_["cells"], map_.cells());
  EXPECT_EQ(geometry_["layers"].size(), 5U);
  EXPECT_EQ(geometry_["extent"],
            (json{{"min_x", -32.0}, {"min_y", -32.0}, {"max_x", 32.0}, {"max_y", 32.0}}));
}

TEST_F(GroundMapFilesTest, DescribeThePositionOfEachTile) {
  write();

  const json& tile = geometry_["tiles"][1];
  EXPECT_EQ(tile["file"], "0_-1.npy");
  EXPECT_EQ(tile["x"], 0);
  EXPECT_EQ(tile["y"], -1);
  EXPECT_EQ(tile["extent"],
            (json{{"min_x", 0.0}, {"min_y", -32.0}, {"max_x", 32.0}, {"max_y", 0.0}}));
  EXPECT_EQ(tile["geotransform"], (json{0.0, 0.5, 0, -32.0, 0, 0.5}));
}

TEST_F(GroundMapFilesTest, OfAnotherMapAreNotListed) {
  std::filesystem::create_directories(folder_ / "ground");
  std::ofstream(files_.tile({.x = 9, .y = 9})) << "a tile of an earlier map";
  std::ofstream(files_.geometry()) << "an earlier map";
  write();

  EXPECT_EQ(geometry_["tiles"].size(), 4U);
  EXPECT_TRUE(std::filesystem::exists(files_.tile({.x = 9, .y = 9})));
}

TEST_F(GroundMapFilesTest, HaveNoGeometryIfATileCannotBeWritten) {
  write();
  std::filesystem::remove(files_.tile({.x = 0, .y = 0}));
  std::filesystem::create_directory(files_.tile({.x = 0, .y = 0}));

  EXPECT_EQ(files_.write(map_).code(), StatusCode::unwritable);
  EXPECT_FALSE(std::filesystem::exists(files_.geometry()));
}

TEST_F(GroundMapFilesTest, CannotBeWrittenIntoAFile) {
  std::ofstream(folder_ / "file") << "x";
  files_.directory = folder_ / "file" / "ground";

  EXPECT_EQ(files_.write(map_).code(), StatusCode::unwritable);
}

TEST_F(GroundMapFilesTest, OfAnEmptyMapListNoTiles) {
  map_ = GroundMap();
  write();

  EXPECT_THAT(names_below(folder_ / "ground"), ElementsAre("map.json"));
  EXPECT_TRUE(geometry_["tiles"].empty());
  EXPECT_TRUE(geometry_["extent"].is_null());
}

TEST(HeightGrid, HasTheHeightsOfTheMap) {
  const GroundMap map = mapped();
  const HeightGrid grid = height_grid(map);

  EXPECT_EQ(grid.columns, 128U);
  EXPECT_EQ(grid.heights.size(), 128U * 128U);
  EXPECT_EQ(grid.cell, 0.5);
  EXPECT_EQ(grid.min_x, -32);
  EXPECT_EQ(grid.min_y, -32);
  // The cell from (3, -8).
  const float height = grid.heights[48 * 128 + 70];
  EXPECT_NEAR(height, sloping_ground(3.25, -7.75), 0.02);
}

TEST(HeightGrid, AveragesTheCellsOfALargeMap) {
  const GroundMap map = mapped();
  const HeightGrid grid = height_grid(map, 40);

  EXPECT_EQ(grid.columns, 32U);
  EXPECT_EQ(grid.cell, 2);
  EXPECT_NEAR(grid.heights[12 * 32 + 17], sloping_ground(3, -7), 0.02);  // from (2, -8) to (4, -6)
}

TEST(HeightGrid, HasAtLeastOneCellPerTile) {
  const HeightGrid grid = height_grid(mapped(), 1);

  EXPECT_EQ(grid.columns, 2U);
  EXPECT_EQ(grid.cell, 32);
  EXPECT_THAT(grid.heights, Each(testing::Truly([](float z) { return std::isfinite(z); })));
}

TEST(HeightGrid, OfAnEmptyMapHasNoCells) { EXPECT_TRUE(height_grid(GroundMap()).heights.empty()); }

}  // namespace
}  // namespace flagstone::app

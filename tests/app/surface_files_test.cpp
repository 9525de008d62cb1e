// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/surface_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/float_array.hpp"
#include "files/io/temporary_folder.hpp"
#include "random_surface.hpp"

namespace flagstone::app {
namespace {

using cli::names_below;
using nlohmann::json;
using testing::ElementsAre;

/// A hill with a kerb, unknown behind x = -20.
float ground(float x, float y) {
  if (x < -20) return std::numeric_limits<float>::quiet_NaN();
  return -1.7f + 2 * std::exp(-(x * x + y * y) / 200) + (y > 3 ? 0.15f : 0);
}

class SurfaceFilesTest : public testing::Test {
 protected:
  /// Writes the surface and reads both files back.
  void write(double resolution = 0) {
    files_.resolution = resolution;
    const Status status = files_.write(surface_);
    ASSERT_TRUE(status.ok()) << status.message();
    grid_ = io::float_array_of(files_.grid());
    frame_ = json::parse(io::contents_of(files_.frame()));
  }

  io::TemporaryFolder folder_;
  GroundSurface surface_ = tests::random_surface(ground);  // 1 m to 32 m, 0.25 m to 8 m
  SurfaceFiles files_{.stem = folder_ / "000000", .scan = "000000.bin", .resolution = 0};
  io::FloatArray grid_;
  json frame_;
};

TEST_F(SurfaceFilesTest, AreAGridAndItsGeometry) {
  write();

  EXPECT_THAT(names_below(folder_.path()),
              ElementsAre("000000.surface.json", "000000.surface.npy"));
}

TEST_F(SurfaceFilesTest, HaveTheFinestCellSizeByDefault) {
  write();

  EXPECT_THAT(grid_.shape, ElementsAre(256, 256));
  EXPECT_EQ(frame_["resolution"], 0.25);
}

TEST_F(SurfaceFilesTest, HaveTheGivenCellSize) {
  write(0.4);

  EXPECT_THAT(grid_.shape, ElementsAre(160, 160));
  EXPECT_EQ(frame_["resolution"], 0.4);
  EXPECT_EQ(frame_["rows"], 160);
  EXPECT_EQ(frame_["columns"], 160);
}

TEST_F(SurfaceFilesTest, HaveTheHeightsAtThePositionsOfTheGeotransform) {
  for (const double resolution : {0.0, 0.4, 3.0}) {
    write(resolution);
    const auto transform = frame_["geotransform"].get<std::vector<double>>();
    ASSERT_EQ(transform.size(), 6U);
    const std::size_t columns = frame_["columns"];
    std::size_t known = 0;

    for (std::size_t i = 0; i < grid_.values.size(); ++i) {
      const double column =
          static_cast<double>(i % columns) + 0.5;  // the centre of the cell, as in GDAL
      const std::size_t rows_before = i / columns;
      const double row = static_cast<double>(rows_before) + 0.5;
      const double x = transform[0] + transform[1] * column + transform[2] * row;
      const double y = transform[3] + transform[4] * column + transform[5] * row;
      const float expected = surface_.height(static_cast<float>(x), static_cast<float>(y));
      ASSERT_EQ(std::isnan(grid_.values[i]), std::isnan(expected)) << x << ' ' << y;
      if (std::isnan(expected)) continue;
      ASSERT_NEAR(grid_.values[i], expected, 1e-5) << x << ' ' << y;
      ++known;
    }

    EXPECT_GT(known, grid_.values.size() / 2);
    EXPECT_LT(known, grid_.values.size());
  }
}

TEST_F(SurfaceFilesTest, StartWithTheLargestYAndTheSmallestX) {
  surface_ = tests::random_surface([](float x, float y) { return 100 * y + x; });
  write(1);

  EXPECT_FLOAT_EQ(grid_.values.front(), 100 * 31.5f - 31.5f);
  EXPECT_FLOAT_EQ(grid_.values[1], 100 * 31.5f - 30.5f);
  EXPECT_FLOAT_EQ(grid_.values.back(), -100 * 31.5f + 31.5f);
}

TEST_F(SurfaceFilesTest, DescribeTheirGeometryAndContents) {
  write();

  EXPECT_EQ(frame_["scan"], "000000.bin");
  EXPECT_EQ(frame_["grid"], "000000.surface.npy");
  EXPECT_EQ(frame_["picture"], "000000.surface.png");
  EXPECT_EQ(frame_["units"], "metres");
  EXPECT_EQ(frame_["nodata"], "NaN");
  EXPECT_EQ(frame_["origin"]["x"], -32);
  EXPECT_EQ(frame_["origin"]["y"], 32);
  EXPECT_EQ(frame_["extent"], json::parse(R"({"min_x":-32,"min_y":-32,"max_x":32,"max_y":32})"));
  EXPECT_EQ(frame_["made_from"],
            json::parse(R"([{"cell":1,"extent":32},{"cell":0.25,"extent":8}])"));
}

TEST_F(SurfaceFilesTest, AreJsonForNonUtf8Names) {
  files_.stem = folder_ / "\xff";
  files_.scan = "\xff.bin";

  write();

  EXPECT_EQ(frame_["scan"], "\uFFFD.bin");
}

TEST_F(SurfaceFilesTest, NameTheFileThatCannotBeWritten) {
  files_.stem = folder_ / "missing/000000";

  const Status status = files_.write(surface_);

  EXPECT_EQ(status.code(), StatusCode::unwritable);
  EXPECT_THAT(status.message(), testing::HasSubstr("missing/000000.surface.npy"));
}

}  // namespace
}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/ground_map_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <vector>

#include "files/io/temporary_folder.hpp"
#include "files/render/canvas.hpp"
#include "files/render/picture.hpp"
#include "numbers.hpp"

namespace flagstone::render {
namespace {

using testing::HasSubstr;

constexpr Color path_color{28, 62, 148};
constexpr Color start_color{0, 132, 92};
constexpr Color end_color{196, 44, 52};

/// A grid of 1 m cells from (0, 0).
struct TestGrid {
  TestGrid(std::size_t columns, std::size_t rows, const std::function<float(double, double)>& z)
      : width(columns) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        heights.push_back(z(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
      }
    }
  }

  [[nodiscard]] GroundGrid view() const { return {.heights = heights, .columns = width}; }

  std::size_t width;
  std::vector<float> heights;
};

class GroundMapImage : public testing::Test {
 protected:
  Picture draw(const TestGrid& grid) {
    options_.path = path_;
    const Status status = draw_ground_map(png_, grid.view(), options_);
    EXPECT_TRUE(status.ok()) << status.message();
    return Picture(png_);
  }

  Status refused(const GroundGrid& grid) { return draw_ground_map(png_, grid, options_); }

  static Rectangle all_of(const Picture& picture) {
    return {0, 0, static_cast<double>(picture.width()), static_cast<double>(picture.height())};
  }

  io::TemporaryFolder folder_;
  std::filesystem::path png_ = folder_ / "ground.png";
  GroundMapPicture options_{.title = "", .subtitle = "", .path = {}, .max_size = 800};
  std::vector<MapPosition> path_;
};

/// Number of pixels that are greenish or brownish, as the relief is.
std::size_t relief_pixels(const Picture& picture, const Rectangle& part) {
  const std::vector<Color> pixels = picture.cut(part);
  return static_cast<std::size_t>(std::ranges::count_if(
      pixels, [](Color color) { return color.blue + 20 < std::max(color.red, color.green); }));
}

TEST_F(GroundMapImage, HasTheMapAsItsShape) {
  const Picture wide = draw({400, 100, [](double, double) { return 0.0F; }});
  const Picture high = draw({100, 400, [](double, double) { return 0.0F; }});

  EXPECT_EQ(wide.width(), 800);
  EXPECT_LT(wide.height(), 600);
  EXPECT_EQ(high.height(), 800);
  EXPECT_LT(high.width(), 600);
}

TEST_F(GroundMapImage, IsAtMostAsLargeAsRequested) {
  for (const std::size_t columns : {1U, 30U, 3000U}) {
    for (const std::size_t rows : {1U, 30U, 3000U}) {
      const Picture picture = draw({columns, rows, [](double, double) { return 0.0F; }});

      EXPECT_LE(std::max(picture.width(), picture.height()), 800) << columns << " x " << rows;
      EXPECT_GE(std::min(picture.width(), picture.height()), 150) << columns << " x " << rows;
    }
  }
}

TEST_F(GroundMapImage, HasXToTheRightAndYUp) {
  // Ground at small x and large y only; the path makes the image show the rest.
  path_ = {{0, 0}, {200, 200}};
  const Picture picture =
      draw({200, 200, [](double x, double y) { return x < 100 && y > 100 ? 0.0F : nan; }});
  const auto half_width = picture.width() / 2.0;
  const auto half_height = picture.height() / 2.0;

  const Rectangle upper_left{0, 0, half_width, half_height};
  const double right = 0.6 * picture.width();  // the panel is not in the middle of the image
  const Rectangle upper_right{right, 0, picture.width() - right, half_height};
  EXPECT_GT(relief_pixels(picture, upper_left), 10'000U);
  EXPECT_LT(relief_pixels(picture, upper_right), 1'000U);
}

TEST_F(GroundMapImage, ColoursHeights) {
  const Picture picture = draw({200, 100, [](double x, double) { return x < 100 ? 0.0F : 5.0F; }});

  const Color low = picture.at(0.35 * picture.width(), 0.45 * picture.height());
  const Color high = picture.at(0.75 * picture.width(), 0.45 * picture.height());
  EXPECT_GT(low.green, low.red);
  EXPECT_GT(high.red, high.green);
}

TEST_F(GroundMapImage, BrightensSlopesThatDescendToTheUpperLeft) {
  const auto hill = [](double x, double y) {
    return static_cast<float>(-0.3 * std::hypot(x - 100, y - 100));
  };
  const Picture picture = draw({200, 200, hill});
  const auto lightness = [](Color color) { return color.red + color.green + color.blue; };

  // Two places of the same height.
  const double x = 0.54 * picture.width();  // about the middle of the panel
  const double y = 0.48 * picture.height();
  const double apart = 0.11 * picture.height();
  EXPECT_GT(lightness(picture.at(x - apart, y - apart)),
            lightness(picture.at(x + apart, y + apart)) + 90);
}

TEST_F(GroundMapImage, DrawsThePathWithItsEnds) {
  for (double x = 10; x <= 190; x += 5) path_.push_back({x, 50});
  const Picture picture = draw({200, 100, [](double, double) { return 0.0F; }});
  const Rectangle all = all_of(picture);

  EXPECT_GT(picture.count(all, path_color), 500U);
  ASSERT_GT(picture.count(all, start_color), 50U);
  ASSERT_GT(picture.count(all, end_color), 50U);
  EXPECT_LT(picture.place(all, start_color).column, picture.place(all, end_color).column - 400);
}

TEST_F(GroundMapImage, MarksARunThatEndsAtItsStartOnce) {
  for (int step = 0; step <= 60; ++step) {
    const double angle = step * std::numbers::pi / 30;
    path_.push_back({100 + 80 * std::cos(angle), 100 + 80 * std::sin(angle)});
  }
  const Picture picture = draw({200, 200, [](double, double) { return 0.0F; }});

  EXPECT_GT(picture.count(all_of(picture), start_color), 50U);
  EXPECT_EQ(picture.count(all_of(picture), end_color), 0U);
}

TEST_F(GroundMapImage, InterruptsThePathAtUnknownPositions) {
  path_ = {{10, 50}, {60, 50}, {nan, nan}, {140, 50}, {190, 50}};
  const TestGrid grid(200, 100, [](double, double) { return 0.0F; });
  const Picture interrupted = draw(grid);
  path_ = {{10, 50}, {60, 50}, {140, 50}, {190, 50}};
  const Picture whole = draw(grid);

  EXPECT_LT(static_cast<double>(interrupted.count(all_of(interrupted), path_color)),
            0.8 * static_cast<double>(whole.count(all_of(whole), path_color)));
}

TEST_F(GroundMapImage, DrawsContourLinesOfHills) {
  const TestGrid flat(200, 100, [](double, double) { return 0.1F; });
  const TestGrid hill(200, 100, [](double x, double) { return static_cast<float>(0.05 * x); });
  const auto dark = [](const Picture& picture) {
    const std::vector<Color> pixels = picture.cut({picture.width() * 0.2, picture.height() * 0.3,
                                                   picture.width() * 0.6, picture.height() * 0.3});
    return std::ranges::count_if(pixels, [](Color color) { return color.green < 140; });
  };

  EXPECT_EQ(dark(draw(flat)), 0);
  EXPECT_GT(dark(draw(hill)), 500);
}

TEST_F(GroundMapImage, IsDeterministic) {
  path_ = {{10, 50}, {190, 60}};
  const TestGrid grid(200, 100, [](double x, double y) {
    return static_cast<float>(std::sin(x / 9) * std::cos(y / 7));
  });
  draw(grid);
  const std::string first = bytes_of(png_);
  draw(grid);

  EXPECT_EQ(bytes_of(png_), first);
}

TEST_F(GroundMapImage, DrawsAnyHeightsAndPositions) {
  draw({50, 50, [](double, double) { return nan; }});
  draw({1, 1, [](double, double) { return 7.0F; }});
  draw({60, 60, [](double x, double) { return x > 30 ? 1e5F : -1e5F; }});
  path_ = {{1e7, 1e7}, {-1e7, -1e7}};
  draw({50, 50, [](double, double) { return 0.0F; }});
}

TEST_F(GroundMapImage, RejectsInvalidGridsAndSizes) {
  const std::vector<float> heights(6, 0.0F);

  EXPECT_THAT(refused({.heights = {}, .columns = 0}).message(), HasSubstr("0 heights"));
  EXPECT_THAT(refused({.heights = heights, .columns = 4}).message(),
              HasSubstr("6 heights in rows of 4 (expected one or more whole rows)"));
  EXPECT_THAT(refused({.heights = heights, .columns = 3, .cell = 0}).message(),
              HasSubstr("cells of 0 m"));
  EXPECT_THAT(refused({.heights = heights, .columns = 3, .min_x = nan}).message(),
              HasSubstr("finite position"));
  options_.max_size = 100;
  EXPECT_THAT(refused({.heights = heights, .columns = 3}).message(),
              HasSubstr("size of 100 pixels (expected 640 to 8192)"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "."));
}

TEST_F(GroundMapImage, ReportsAFileThatCannotBeWritten) {
  png_ = folder_ / "missing" / "ground.png";

  EXPECT_EQ(refused({.heights = std::vector<float>(4, 0.0F), .columns = 2}).code(),
            StatusCode::unwritable);
}

}  // namespace
}  // namespace flagstone::render

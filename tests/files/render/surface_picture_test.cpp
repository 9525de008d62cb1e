// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/surface_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "files/io/temporary_folder.hpp"
#include "files/render/canvas.hpp"
#include "files/render/picture.hpp"
#include "numbers.hpp"
#include "random_surface.hpp"

namespace flagstone::render {
namespace {

double lightness(Color color) { return 0.3 * color.red + 0.59 * color.green + 0.11 * color.blue; }

class SurfaceImage : public testing::Test {
 protected:
  SurfaceImage() {
    options_.width = 800;
    options_.height = 890;
    options_.range = 20;
  }

  Picture draw(const GroundSurface& surface) {
    const Status status = draw_surface(png_, surface, options_);
    EXPECT_TRUE(status.ok()) << status.message();
    return Picture(png_);
  }

  [[nodiscard]] TopView view() const {
    return {arrange(options_.width, options_.height, 1).panel, options_.range};
  }

  /// The colour at (x, y), metres.
  [[nodiscard]] Color color(const Picture& picture, double x, double y) const {
    return picture.at(view().column(y), view().row(x));
  }

  /// Whether a thin or bold contour line is within two pixels ahead of or behind (x, y).
  [[nodiscard]] bool has_line(const Picture& picture, double x, double y) const {
    const double ground = lightness(color(picture, x + 0.5, y));
    double darkest = 255;
    for (int offset = -2; offset <= 2; ++offset) {
      darkest = std::min(darkest, lightness(picture.at(view().column(y), view().row(x) + offset)));
    }
    return darkest < ground - 25;
  }

  io::TemporaryFolder folder_;
  std::filesystem::path png_ = folder_ / "ground.png";
  SurfacePicture options_;
};

TEST_F(SurfaceImage, HasTheRequestedSize) {
  const Picture picture = draw(tests::random_surface([](float, float) { return -1.7f; }));

  EXPECT_EQ(picture.width(), 800);
  EXPECT_EQ(picture.height(), 890);
}

TEST_F(SurfaceImage, LeavesUnknownGroundBlank) {
  const Picture picture =
      draw(tests::random_surface([](float x, float) { return x > 10 ? nan : -1.7f; }));

  EXPECT_EQ(color(picture, 15, 3), page_color);
  EXPECT_NE(color(picture, 5, 3), page_color);
}

TEST_F(SurfaceImage, UsesDifferentColoursForHeights) {
  const Picture picture =
      draw(tests::random_surface([](float, float y) { return y > 0 ? -1.0f : -3.0f; }));

  const Color low = color(picture, 7.3, -7.3);
  const Color high = color(picture, 7.3, 7.3);
  EXPECT_GT(low.green, low.red);    // greens
  EXPECT_GT(high.red, high.green);  // browns
}

TEST_F(SurfaceImage, BrightensSlopesThatDescendToTheUpperLeft) {
  const auto ridge = [](float x, float y) { return -0.2f * std::abs(x + y); };

  const Picture picture = draw(tests::random_surface(ridge));

  // Two points of the same height: ahead to the left, and behind to the right.
  EXPECT_GT(lightness(color(picture, 3.1, 3.2)), lightness(color(picture, -3.1, -3.2)) + 30);
}

TEST_F(SurfaceImage, IsPalerWhereConfidenceIsLower) {
  GroundSurface surface = tests::random_surface([](float, float) { return -1.7f; });
  for (GroundSurface::Grid& grid : surface.start()) std::ranges::fill(grid.confidences, 0.2f);
  const Picture unsure = draw(surface);
  for (GroundSurface::Grid& grid : surface.start()) std::ranges::fill(grid.confidences, 1.0f);
  const Picture sure = draw(surface);

  EXPECT_GT(lightness(color(unsure, 5.2, 5.3)), lightness(color(sure, 5.2, 5.3)) + 10);
}

TEST_F(SurfaceImage, DrawsALineAtEachContourHeight) {
  // Heights from -4 m behind to 0 m ahead, a line per 0.5 m: lines are 5 m apart.
  const Picture picture = draw(tests::random_surface([](float x, float) { return -2 + 0.1f * x; }));

  for (const double x : {-15.0, -10.0, -5.0, 0.0, 5.0, 10.0, 15.0})
    EXPECT_TRUE(has_line(picture, x, 12.3)) << x;
  for (const double x : {-12.5, -7.5, -2.5, 2.5, 7.5, 12.5})
    EXPECT_FALSE(has_line(picture, x, 12.3)) << x;
}

TEST_F(SurfaceImage, ShowsTheConfidentAreaUnlessARangeIsGiven) {
  GroundSurface surface = tests::random_surface([](float, float) { return -1.7f; },
                                                std::vector<tests::GridSize>{{1, 128}});
  GroundSurface::Grid& grid = surface.start()[0];
  for (std::size_t row = 0; row < grid.width; ++row) {
    for (std::size_t column = 0; column < grid.width; ++column) {
      const bool is_near = std::max(std::abs(static_cast<double>(row) - 63.5),
                                    std::abs(static_cast<double>(column) - 63.5)) < 17;
      grid.confidences[row * grid.width + column] = is_near ? 1 : 0;
    }
  }
  options_.range = 0;
  const Picture suited = draw(surface);
  options_.range = 20;

  EXPECT_EQ(suited.cut({0, 0, 800, 890}), draw(surface).cut({0, 0, 800, 890}));
}

TEST_F(SurfaceImage, IsDeterministic) {
  const GroundSurface surface =
      tests::random_surface([](float x, float y) { return std::sin(x / 5) * std::cos(y / 4); });
  draw(surface);
  const std::string first = bytes_of(png_);
  draw(surface);

  EXPECT_EQ(bytes_of(png_), first);
}

TEST_F(SurfaceImage, DrawsASurfaceWithoutKnownGround) {
  const Picture picture = draw(tests::random_surface([](float, float) { return nan; }));

  EXPECT_EQ(color(picture, 10, 10), page_color);
}

TEST_F(SurfaceImage, DrawsGroundOfAnyHeight) {
  draw(tests::random_surface([](float x, float) { return x > 0 ? 1e4f : -1e4f; }));
}

TEST_F(SurfaceImage, RejectsAnEmptySurface) {
  const Status status = draw_surface(png_, GroundSurface(), options_);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_EQ(status.message(),
            "surface image: there is no surface (the method does not provide one)");
  EXPECT_FALSE(std::filesystem::exists(png_));
}

TEST_F(SurfaceImage, RejectsSizesAndRangesOutOfLimits) {
  const GroundSurface surface = tests::random_surface([](float, float) { return 0.0f; });
  options_.width = 100;
  EXPECT_EQ(draw_surface(png_, surface, options_).message(),
            "surface image: size 100 x 890 pixels (expected 320 to 8192 each)");
  options_.width = 800;
  options_.range = nan;
  EXPECT_EQ(draw_surface(png_, surface, options_).code(), StatusCode::invalid_argument);
}

TEST_F(SurfaceImage, ReportsThePathThatCannotBeWritten) {
  const GroundSurface surface = tests::random_surface([](float, float) { return 0.0f; });

  EXPECT_EQ(draw_surface(folder_ / "missing/ground.png", surface, options_).code(),
            StatusCode::unwritable);
}

}  // namespace
}  // namespace flagstone::render

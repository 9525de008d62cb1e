// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT

// Built with the functions that replace drawing without Cairo.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "files/io/temporary_folder.hpp"
#include "files/render/birds_eye.hpp"
#include "files/render/ground_map_picture.hpp"
#include "files/render/rendering_available.hpp"
#include "files/render/side_by_side.hpp"
#include "files/render/surface_picture.hpp"

namespace flagstone::render {
namespace {

TEST(WithoutCairo, ReportsWhatToInstall) {
  const Status rendering_available = render::rendering_available();

  EXPECT_FALSE(rendering_available.ok());
  EXPECT_THAT(rendering_available.message(), testing::HasSubstr("libcairo2-dev"));
}

TEST(WithoutCairo, EveryDrawingFunctionReportsTheSameAndWritesNothing) {
  const io::TemporaryFolder folder;
  std::vector<std::byte> png;

  const std::array drawn = {
      draw_birds_eye(folder / "a.png", {}, {}, {}), draw_surface(folder / "b.png", {}, {}),
      draw_ground_map(folder / "c.png", {}, {}), render_side_by_side({}, {}, {}, {}, png)};

  for (const Status& status : drawn) EXPECT_EQ(status.message(), rendering_available().message());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
  EXPECT_TRUE(png.empty());
}

}  // namespace
}  // namespace flagstone::render

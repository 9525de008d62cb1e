// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/render/birds_eye.hpp"
#include "files/render/canvas.hpp"
#include "flagstone/label.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone::render {

bool operator==(const Color& a, const Color& b) noexcept;
void PrintTo(const Color& color, std::ostream* out);

/// Points that are rightly ground, wrongly not ground, wrongly ground.
inline constexpr Color green{44, 166, 96};
inline constexpr Color blue{66, 140, 255};
inline constexpr Color red{255, 72, 56};

/// A PNG file read back with Cairo; without pixels where it is no valid picture.
class Picture {
 public:
  explicit Picture(const std::filesystem::path& png);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] Color at(double column, double row) const;

  /// How many pixels of `part` have exactly this colour.
  [[nodiscard]] std::size_t count(const Rectangle& part, Color color) const;

  /// Middle of the pixels of `part` that have exactly this colour; there must be some.
  struct Place {
    double column, row;
  };
  [[nodiscard]] Place place(const Rectangle& part, Color color) const;

  /// The pixels of `part`, row by row.
  [[nodiscard]] std::vector<Color> cut(const Rectangle& part) const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<Color> pixels_;
};

/// Points with the labels a segmenter would have given them.
struct LabelledScan {
  std::vector<Point> points;
  Segmentation result;

  void add(float x, float y, float z, Label label);
  [[nodiscard]] CloudView cloud() const noexcept;

 private:
  std::vector<Label> labels_;
};

/// Draws into a folder of its own, which goes with the test.
class PictureTest : public testing::Test {
 public:
  PictureTest(const PictureTest&) = delete;
  PictureTest& operator=(const PictureTest&) = delete;

 protected:
  PictureTest();
  ~PictureTest() override;

  /// Draws the scan, expects success and reads the picture back.
  Picture draw(const LabelledScan& scan);

  /// Where points are drawn in pictures of the options' size.
  [[nodiscard]] Rectangle panel() const noexcept;

  std::filesystem::path folder_;
  std::filesystem::path png_;
  BirdsEye options_;
};

/// A file's bytes; empty where there is none.
std::string bytes_of(const std::filesystem::path& file);

}  // namespace flagstone::render

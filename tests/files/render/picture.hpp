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

/// Colours of true positives, false negatives and false positives.
inline constexpr Color green{44, 166, 96};
inline constexpr Color blue{66, 140, 255};
inline constexpr Color red{255, 72, 56};

/// A PNG file read back with Cairo. It has no pixels if the file is not a valid image.
class Picture {
 public:
  explicit Picture(const std::filesystem::path& png);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] Color at(double column, double row) const;

  /// Number of pixels of `part` with exactly this colour.
  [[nodiscard]] std::size_t count(const Rectangle& part, Color color) const;

  /// Mean position of the pixels of `part` with exactly this colour. At least one must exist.
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

/// Points with labels, as from a segmenter.
struct LabelledScan {
  std::vector<Point> points;
  Segmentation result;

  void add(float x, float y, float z, Label label);
  [[nodiscard]] CloudView cloud() const noexcept;

 private:
  std::vector<Label> labels_;
};

/// Draws into a temporary directory, which is removed after the test.
class PictureTest : public testing::Test {
 public:
  PictureTest(const PictureTest&) = delete;
  PictureTest& operator=(const PictureTest&) = delete;

 protected:
  PictureTest();
  ~PictureTest() override;

  /// Draws the scan, expects success and reads the image back.
  Picture draw(const LabelledScan& scan);

  /// Positions of points in images of the size in the options.
  [[nodiscard]] Rectangle panel() const noexcept;

  std::filesystem::path folder_;
  std::filesystem::path png_;
  BirdsEye options_;
};

/// The bytes of a file; empty if it does not exist.
std::string bytes_of(const std::filesystem::path& file);

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/picture.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <ostream>
#include <span>

#include "files/render/canvas.hpp"

namespace flagstone::render {

bool operator==(const Color& a, const Color& b) noexcept {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

void PrintTo(const Color& color, std::ostream* out) {
  *out << "rgb(" << int{color.red} << ", " << int{color.green} << ", " << int{color.blue} << ")";
}

Picture::Picture(const std::filesystem::path& png) {
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_image_surface_create_from_png(png.c_str()), cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return;
  width_ = cairo_image_surface_get_width(surface.get());
  height_ = cairo_image_surface_get_height(surface.get());
  const auto row_length = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())) /
                          sizeof(std::uint32_t);
  const auto* data =
      reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
  for (std::size_t row = 0; row < static_cast<std::size_t>(height_); ++row)
    for (const std::uint32_t pixel :
         std::span(data + row * row_length, static_cast<std::size_t>(width_)))
      pixels_.emplace_back(static_cast<std::uint8_t>(pixel >> 16),
                           static_cast<std::uint8_t>(pixel >> 8), static_cast<std::uint8_t>(pixel));
}

Color Picture::at(double column, double row) const {
  return pixels_.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(column));
}

std::size_t Picture::count(const Rectangle& part, Color color) const {
  return static_cast<std::size_t>(std::ranges::count(cut(part), color));
}

Picture::Place Picture::place(const Rectangle& part, Color color) const {
  const std::vector<Color> pixels = cut(part);
  const auto row_length = static_cast<std::size_t>(part.width);
  double columns = 0;
  double rows = 0;
  double count = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (!(pixels[i] == color)) continue;
    const std::size_t row = i / row_length;
    columns += part.x + static_cast<double>(i - row * row_length) + 0.5;
    rows += part.y + static_cast<double>(row) + 0.5;
    ++count;
  }
  EXPECT_GT(count, 0) << "no pixel of colour " << testing::PrintToString(color);
  return {.column = columns / count, .row = rows / count};
}

std::vector<Color> Picture::cut(const Rectangle& part) const {
  std::vector<Color> pixels;
  for (int row = 0; row < static_cast<int>(part.height); ++row)
    for (int column = 0; column < static_cast<int>(part.width); ++column)
      pixels.push_back(at(part.x + column, part.y + row));
  return pixels;
}

void LabelledScan::add(float x, float y, float z, Label label) {
  points.push_back({.x = x, .y = y, .z = z});
  labels_.push_back(label);
  std::ranges::copy(labels_, result.start(labels_.size()).begin());
  result.finish();
}

CloudView LabelledScan::cloud() const noexcept { return CloudView(std::span<const Point>(points)); }

PictureTest::PictureTest() {
  std::string name = (std::filesystem::temp_directory_path() / "flagstone-picture-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::filesystem::filesystem_error("mkdtemp", {});
  folder_ = name;
  png_ = folder_ / "scan.png";
  options_.range = 40;
  options_.width = 800;
  options_.height = 890;
}

PictureTest::~PictureTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Picture PictureTest::draw(const LabelledScan& scan) {
  const Status status = draw_birds_eye(png_, scan.cloud(), scan.result, options_);
  EXPECT_TRUE(status.ok()) << status.message();
  return Picture(png_);
}

Rectangle PictureTest::panel() const noexcept {
  return arrange(options_.width, options_.height, options_.tint_patches ? 2 : 1).panel;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace flagstone::render

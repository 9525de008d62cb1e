// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/open_land.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace flagstone::sim {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

double WindingPath::y(double x) const noexcept {
  return slope * x + swing * std::sin(full_turn * x / swing_length);
}

Stop WindingPath::at(double x) const noexcept {
  const double wave = full_turn / swing_length;
  return {.x = x, .y = y(x), .yaw = std::atan(slope + swing * wave * std::cos(wave * x))};
}

double smooth_step(double begin, double end, double value) noexcept {
  const double share = std::clamp((value - begin) / (end - begin), 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

std::vector<double> lines_in_bands(double begin, std::span<const LineBand> bands) {
  std::vector<double> lines{begin};
  for (const LineBand& band : bands) {
    const double from = lines.back();
    const int count = static_cast<int>(std::ceil((band.end - from) / band.step - 1e-9));
    for (int i = 1; i <= count; ++i) lines.push_back(from + (band.end - from) * i / count);
  }
  return lines;
}

std::vector<double> mirrored_lines(std::span<const LineBand> bands) {
  const std::vector<double> outward = lines_in_bands(0, bands);
  std::vector<double> lines;
  for (auto line = outward.rbegin(); line != outward.rend(); ++line) lines.push_back(-*line);
  lines.insert(lines.end(), outward.begin() + 1, outward.end());
  return lines;
}

std::vector<double> merged_lines(std::vector<double> lines, std::span<const double> others) {
  constexpr double same = 1e-6;  // metres
  lines.insert(lines.end(), others.begin(), others.end());
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines, [](double a, double b) { return b - a < same; });
  lines.erase(repeated.begin(), repeated.end());
  return lines;
}

Ground make_land(std::vector<double> x, std::vector<double> t,
                 const std::function<double(double x)>& offset, const LandHeight& height,
                 const LandSurface& surface) {
  GroundGrid grid{.x = std::move(x), .offset = {}, .t = std::move(t)};
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  heights.reserve(grid.x.size() * grid.t.size());
  surfaces.reserve(heights.capacity());
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    grid.offset.push_back(offset(grid.x[i]));
    for (const double at : grid.t) heights.push_back(height(grid.x[i], at));
    if (i + 1 == grid.x.size()) break;
    const double middle_x = (grid.x[i] + grid.x[i + 1]) / 2;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(surface(middle_x, (grid.t[j] + grid.t[j + 1]) / 2));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

void scatter(const WindingPath& path, const Strip& strip, double per_square_metre, Random& random,
             const std::function<void(double x, double y)>& put) {
  const double length = strip.x.high - strip.x.low;
  const double area = 2 * length * (strip.from_path.high - strip.from_path.low);
  const int count = static_cast<int>(per_square_metre * area);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(strip.x.low, strip.x.high);
    const double t = random.uniform(strip.from_path.low, strip.from_path.high);
    put(x, path.y(x) + (random.chance(0.5) ? t : -t));
  }
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/contours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "files/render/canvas.hpp"
#include "files/render/text.hpp"

namespace flagstone::render {
namespace {

/// A side of a square, between two adjacent samples. The first half of the values are sides along
/// rows, numbered by their left sample; the others are along columns, numbered by their upper
/// sample.
using Side = std::uint32_t;
constexpr Side none = std::numeric_limits<Side>::max();

class Tracer {
 public:
  Tracer(std::span<const float> heights, std::size_t width, float level)
      : heights_(heights),
        width_(static_cast<Side>(width)),
        samples_(static_cast<Side>(heights.size())),
        level_(level),
        links_(2 * heights.size(), {none, none}) {
    for (Side sample = 0; sample + width_ < samples_; ++sample) {
      if (sample % width_ + 1 < width_) link_square(sample);
    }
  }

  std::vector<ContourLine> trace() {
    std::vector<ContourLine> lines;
    // Follow open lines from their ends first; the remaining lines are closed.
    for (Side side = 0; side < links_.size(); ++side) {
      if (links_[side][0] != none && links_[side][1] == none) lines.push_back(follow(side));
    }
    for (Side side = 0; side < links_.size(); ++side) {
      if (links_[side][0] != none) lines.push_back(follow(side));
    }
    return lines;
  }

 private:
  [[nodiscard]] bool is_above(Side sample) const { return heights_[sample] >= level_; }

  /// Links the sides that the level crosses, in the square to the right of and below `sample`.
  void link_square(Side sample) {
    const std::array corners = {sample, sample + 1, sample + width_, sample + width_ + 1};
    if (!std::ranges::all_of(corners, [&](Side s) { return std::isfinite(heights_[s]); })) return;
    const Side upper = sample;
    const Side lower = sample + width_;
    const Side left = samples_ + sample;
    const Side right = samples_ + sample + 1;
    const bool upper_left = is_above(corners[0]);
    const bool upper_right = is_above(corners[1]);
    const bool lower_left = is_above(corners[2]);
    const bool lower_right = is_above(corners[3]);
    std::array<Side, 4> passed{};
    std::size_t count = 0;
    if (upper_left != upper_right) passed[count++] = upper;
    if (upper_left != lower_left) passed[count++] = left;
    if (upper_right != lower_right) passed[count++] = right;
    if (lower_left != lower_right) passed[count++] = lower;
    if (count == 2) link(passed[0], passed[1]);
    if (count < 4) return;
    // At a saddle, the lines are connected as in the bilinear surface.
    if (upper_left == (saddle_height(corners) >= level_)) {
      link(upper, right);
      link(left, lower);
    } else {
      link(upper, left);
      link(right, lower);
    }
  }

  [[nodiscard]] double saddle_height(const std::array<Side, 4>& corners) const {
    const double a = heights_[corners[0]];
    const double b = heights_[corners[1]];
    const double c = heights_[corners[2]];
    const double d = heights_[corners[3]];
    return (a * d - b * c) / (a + d - b - c);
  }

  void link(Side one, Side other) {
    links_[one][links_[one][0] == none ? 0 : 1] = other;
    links_[other][links_[other][0] == none ? 0 : 1] = one;
  }

  /// Removes the link from one side to another.
  void unlink(Side from, Side to) {
    auto& [first, second] = links_[from];
    if (first == to) first = second;
    second = none;
  }

  ContourLine follow(Side side) {
    ContourLine line = {place(side)};
    while (links_[side][0] != none) {
      const Side next = links_[side][0];
      unlink(side, next);
      unlink(next, side);
      side = next;
      line.push_back(place(side));
    }
    return line;
  }

  /// The position at which the level crosses a side.
  [[nodiscard]] GridPlace place(Side side) const {
    const bool is_along_row = side < samples_;
    const Side sample = is_along_row ? side : side - samples_;
    const double here = heights_[sample];
    const double there = heights_[sample + (is_along_row ? 1 : width_)];
    const double share = (level_ - here) / (there - here);
    const auto column = static_cast<double>(sample % width_);
    const Side whole_rows = sample / width_;
    const auto row = static_cast<double>(whole_rows);
    return is_along_row ? GridPlace{column + share, row} : GridPlace{column, row + share};
  }

  std::span<const float> heights_;
  Side width_;
  Side samples_;
  float level_;
  std::vector<std::array<Side, 2>> links_;  // for each side: the sides linked to it
};

}  // namespace

std::vector<ContourLine> contour_lines(std::span<const float> heights, std::size_t width,
                                       float level) {
  return Tracer(heights, width, level).trace();
}

namespace {

struct Spot {
  double x, y;  // pixels
};
using Path = std::vector<Spot>;

double distance(const Spot& a, const Spot& b) noexcept { return std::hypot(a.x - b.x, a.y - b.y); }

Path in_pixels(const ContourLine& line, const cairo_matrix_t& to_pixels) {
  Path path;
  path.reserve(line.size());
  for (const auto& [column, row] : line) {
    Spot spot{column, row};
    cairo_matrix_transform_point(&to_pixels, &spot.x, &spot.y);
    path.push_back(spot);
  }
  return path;
}

double length_of(const Path& path) noexcept {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
  return length;
}

void stroke(cairo_t* context, const Path& path) noexcept {
  cairo_move_to(context, path.front().x, path.front().y);
  for (const Spot& spot : path) cairo_line_to(context, spot.x, spot.y);
  cairo_stroke(context);
}

/// A possible position of a label: the middle of a piece of the line as long as the label is wide.
struct LabelPlace {
  Spot middle;
  double angle;     // of the text, radians
  double straight;  // chord length / arc length of the piece, at most 1
};

class LabelPlacer {
 public:
  LabelPlacer(const Rectangle& panel, double unit) : panel_(panel), unit_(unit) {}

  /// The straightest position on this line for a label `width` pixels wide, far from all other
  /// labels. Nothing if the line bends too much everywhere.
  std::optional<LabelPlace> place(const Path& path, double width) {
    std::optional<LabelPlace> best;
    std::size_t end = 0;
    double piece = 0;  // length from begin to end
    for (std::size_t begin = 0; begin + 1 < path.size(); ++begin) {
      for (; end + 1 < path.size() && piece < width; ++end)
        piece += distance(path[end], path[end + 1]);
      if (piece < width) break;
      const LabelPlace candidate = between(path, begin, end, piece);
      if (is_free(candidate.middle, width) && (!best || candidate.straight > best->straight))
        best = candidate;
      piece -= distance(path[begin], path[begin + 1]);
    }
    constexpr double straight_enough = 0.93;
    if (!best || best->straight < straight_enough) return std::nullopt;
    taken_.push_back(best->middle);
    return best;
  }

 private:
  static LabelPlace between(const Path& path, std::size_t begin, std::size_t end, double piece) {
    const Spot& from = path[begin];
    const Spot& to = path[end];
    double angle = std::atan2(to.y - from.y, to.x - from.x);
    // Keep the text upright for either direction of the line.
    if (std::abs(angle) > std::numbers::pi / 2) angle -= std::copysign(std::numbers::pi, angle);
    return {path[begin + (end - begin) / 2], angle, distance(from, to) / piece};
  }

  [[nodiscard]] bool is_free(const Spot& spot, double width) const {
    const double apart = 190 * unit_;
    const bool is_inside = spot.x > panel_.x + width && spot.x < panel_.right() - width &&
                           spot.y > panel_.y + width && spot.y < panel_.bottom() - width;
    return is_inside && std::ranges::none_of(taken_, [&](const Spot& other) {
             return distance(spot, other) < apart;
           });
  }

  Rectangle panel_;
  double unit_;
  std::vector<Spot> taken_;
};

void draw_label(cairo_t* context, const LabelPlace& place, const std::string& text,
                const Font& font) {
  cairo_save(context);
  cairo_translate(context, place.middle.x, place.middle.y);
  cairo_rotate(context, place.angle);
  draw_edged_text(context, 0, font.size * 0.36, text, font, page_color, Align::center);
  cairo_restore(context);
}

}  // namespace

ContourStep suitable_step(double span) noexcept {
  constexpr double most_lines = 14;
  constexpr std::array<ContourStep, 3> round_steps = {{{1, 2}, {2, 5}, {5, 2}}};
  constexpr double largest = 1000;  // metres; more than any scan spans
  for (const ContourStep& step : {ContourStep{0.25, 2}, ContourStep{0.5, 2}}) {
    if (span <= most_lines * step.height) return step;
  }
  for (double power = 1; power < largest; power *= 10) {
    for (const ContourStep& step : round_steps) {
      if (span <= most_lines * power * step.height) return {power * step.height, step.per_index};
    }
  }
  return {largest, 2};
}

std::string height_text(double height, const ContourStep& step) {
  const int places = step.height < 0.5 ? 2 : step.height < 1 ? 1 : 0;
  std::string text = fmt::format("{:.{}f}", height, places);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (!text.starts_with('-')) return text;
  return is_zero ? text.substr(1) : "\u2212" + text.substr(1);  // a minus sign, wider than a hyphen
}

void draw_contours(const Canvas& canvas, const Rectangle& panel, const ContourGrid& grid,
                   const HeightRange& heights, const ContourStep& step, double unit) {
  cairo_t* context = canvas.context();
  cairo_save(context);
  add_rectangle(context, panel);
  cairo_clip(context);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  const Font font{.size = 19 * unit, .bold = true, .color = contour_color};
  struct Index {
    std::string text;
    Path path;
  };
  std::vector<Index> indices;
  set_color(context, contour_color, 0.55);
  cairo_set_line_width(context, thin_contour * unit);
  for (auto number = static_cast<long>(std::ceil(heights.lowest / step.height));
       static_cast<double>(number) * step.height <= heights.highest; ++number) {
    const double height = static_cast<double>(number) * step.height;
    for (const ContourLine& line :
         contour_lines(grid.heights, grid.width, static_cast<float>(height))) {
      Path path = in_pixels(line, grid.to_pixels);
      if (length_of(path) < 24 * unit) continue;  // too short to draw
      if (number % step.per_index == 0) {
        indices.push_back({height_text(height, step), std::move(path)});
      } else {
        stroke(context, path);
      }
    }
  }
  set_color(context, contour_color, 0.8);
  cairo_set_line_width(context, bold_contour * unit);
  for (const Index& index : indices) stroke(context, index.path);
  // Label the longest lines first.
  std::ranges::sort(indices, std::greater(), [](const Index& i) { return length_of(i.path); });
  LabelPlacer placer(panel, unit);
  for (const Index& index : indices) {
    const double width = text_width(context, index.text, font) + 12 * unit;
    const auto wanted = static_cast<int>(std::ceil(length_of(index.path) / (900 * unit)));
    for (int label = 0; label < wanted; ++label) {
      const auto place = placer.place(index.path, width);
      if (!place) break;
      draw_label(context, *place, index.text, font);
    }
  }
  cairo_restore(context);
}

}  // namespace flagstone::render

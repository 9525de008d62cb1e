// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/contour_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace flagstone::render {
namespace {

/// Sides of squares, each between two neighbouring samples. The first half of them run along rows,
/// each named by its left sample, the others along columns, named by the upper one.
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
    // From the ends first: what is left then are closed lines.
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

  /// Joins the sides of the square right of and below `sample` that the level passes.
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
    // Two lines pass a saddle on the same side of it as the bilinear surface does.
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

  /// Takes the link from one side to the next away.
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

  /// Where the level passes a side.
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
  std::vector<std::array<Side, 2>> links_;  // by side: the sides it is joined to
};

}  // namespace

std::vector<ContourLine> contour_lines(std::span<const float> heights, std::size_t width,
                                       float level) {
  return Tracer(heights, width, level).trace();
}

}  // namespace flagstone::render

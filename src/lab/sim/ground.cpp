// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "lab/sim/alignment.hpp"
#include "lab/sim/cross_lines.hpp"

namespace flagstone::sim {

namespace {

bool ascends(const std::vector<double>& lines) {
  return std::ranges::adjacent_find(lines, std::greater_equal<>{}) == lines.end();
}

// Index of the cell that contains `value`; the first or last cell if it is outside.
std::size_t cell_of(const std::vector<double>& lines, double value) noexcept {
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, value);
  return static_cast<std::size_t>(above - lines.begin()) - 1;
}

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

// A quantity that changes linearly along a ray.
struct Ground::Along {
  double begin = 0, rate = 0;
  // The distance at which it reaches 0; never if it does not decrease.
  [[nodiscard]] double zero() const noexcept { return rate < 0 ? -begin / rate : never; }

  friend Along operator+(double a, Along b) noexcept { return {a + b.begin, b.rate}; }
  friend Along operator+(Along a, Along b) noexcept { return {a.begin + b.begin, a.rate + b.rate}; }
  friend Along operator*(double a, Along b) noexcept { return {a * b.begin, a * b.rate}; }
  friend Along operator-(Along a) noexcept { return -1 * a; }
  friend Along operator-(Along a, Along b) noexcept { return a + -b; }
};

// The position of a ray in a cell.
struct Ground::CellPlace {
  Along u, v;
};

Ground::Ground(GroundGrid grid, std::vector<double> heights, std::vector<Surface> surfaces)
    : grid_(std::move(grid)), heights_(std::move(heights)), surfaces_(std::move(surfaces)) {
  const std::size_t rows = grid_.x.size();
  const std::size_t columns = grid_.t.size();
  if (rows < 2 || columns < 2 || !ascends(grid_.x) || !ascends(grid_.t)) {
    throw std::invalid_argument("ground grid: x and t must have at least 2 ascending lines each");
  }
  if (grid_.offset.size() != rows || heights_.size() != rows * columns ||
      surfaces_.size() != (rows - 1) * (columns - 1)) {
    throw std::invalid_argument(
        "ground grid: sizes do not match (expected one offset per x line, one height per grid "
        "point "
        "and one surface per cell)");
  }
}

namespace {

// Half of a cell whose sides are not parallel: a corner, and the sides along x and t.
struct HalfCell {
  Vector3 corner, along, across;
  [[nodiscard]] double twice_area() const noexcept {
    return along.x * across.y - along.y * across.x;
  }
};

HalfCell half_cell(const CrossLine& line, const CrossLine& next, double t, double next_t,
                   bool is_lower) noexcept {
  const Vector3 corner = line.at(t);
  return is_lower ? HalfCell{corner, next.at(t) - corner, next.at(next_t) - next.at(t)}
                  : HalfCell{corner, next.at(next_t) - line.at(next_t), line.at(next_t) - corner};
}

}  // namespace

// Each half of a cell is a linear image of half a square.
Ground::Place Ground::place_on_bend(double x, double y) const noexcept {
  Place at{};
  at.i = bend_.before(x, y);
  const CrossLine& line = bend_[at.i];
  const CrossLine& next = bend_[at.i + 1];
  const double from_line = line.ahead(x, y);
  const double to_next = -next.ahead(x, y);
  const double t =
      (to_next * line.aside(x, y) + from_line * next.aside(x, y)) / (from_line + to_next);
  at.j = cell_of(grid_.t, t);
  const auto in_half = [&](bool is_lower) {
    const HalfCell half = half_cell(line, next, grid_.t[at.j], grid_.t[at.j + 1], is_lower);
    const double dx = x - half.corner.x;
    const double dy = y - half.corner.y;
    at.u = (dx * half.across.y - dy * half.across.x) / half.twice_area();
    at.v = (half.along.x * dy - half.along.y * dx) / half.twice_area();
  };
  const auto in_cell = [&] {
    in_half(true);
    if (at.u < at.v) in_half(false);
  };
  in_cell();
  // The lines along the road are not quite in the ratio of the distances: t may be of a neighbour.
  while (at.v < 0 && at.j > 0) {
    --at.j;
    in_cell();
  }
  while (at.v > 1 && at.j + 2 < grid_.t.size()) {
    ++at.j;
    in_cell();
  }
  return at;
}

Ground::Place Ground::place(double x, double y) const noexcept {
  if (!bend_.empty()) return place_on_bend(x, y);
  if (grid_.closed) {
    const double length = grid_.x.back() - grid_.x.front();
    x -= length * std::floor((x - grid_.x.front()) / length);
  }
  Place at{};
  at.i = cell_of(grid_.x, x);
  at.u = (x - grid_.x[at.i]) / (grid_.x[at.i + 1] - grid_.x[at.i]);
  const double t = y - (grid_.offset[at.i] + at.u * (grid_.offset[at.i + 1] - grid_.offset[at.i]));
  at.j = cell_of(grid_.t, t);
  at.v = (t - grid_.t[at.j]) / (grid_.t[at.j + 1] - grid_.t[at.j]);
  return at;
}

double Ground::height(double x, double y) const noexcept {
  const Place at = place(x, y);
  const double h00 = grid_height(at.i, at.j);
  const double h10 = grid_height(at.i + 1, at.j);
  const double h01 = grid_height(at.i, at.j + 1);
  const double h11 = grid_height(at.i + 1, at.j + 1);
  // The two triangles of add_to(), below and above the diagonal of the cell.
  return at.u >= at.v ? h00 + at.u * (h10 - h00) + at.v * (h11 - h10)
                      : h00 + at.v * (h01 - h00) + at.u * (h11 - h01);
}

const Surface& Ground::surface(double x, double y) const noexcept {
  const Place at = place(x, y);
  return surfaces_[at.i * (grid_.t.size() - 1) + at.j];
}

bool Ground::covers(double x, double y) const noexcept {
  const Place at = place(x, y);
  return at.u >= 0 && at.u <= 1 && at.v >= 0 && at.v <= 1;
}

Ground::CellPlace Ground::along_straight(std::size_t i, std::size_t j, const Along& x,
                                         const Along& y) const noexcept {
  const double bend = grid_.offset[i + 1] - grid_.offset[i];
  const Along u = 1 / (grid_.x[i + 1] - grid_.x[i]) * (-grid_.x[i] + x);
  const Along t = -grid_.offset[i] + (y - bend * u);
  return {.u = u, .v = 1 / (grid_.t[j + 1] - grid_.t[j]) * (-grid_.t[j] + t)};
}

Ground::CellPlace Ground::along_bend(std::size_t i, std::size_t j, bool is_lower, const Along& x,
                                     const Along& y) const noexcept {
  const HalfCell half = half_cell(bend_[i], bend_[i + 1], grid_.t[j], grid_.t[j + 1], is_lower);
  const Along dx = -half.corner.x + x;
  const Along dy = -half.corner.y + y;
  const double scale = 1 / half.twice_area();
  return {.u = scale * (half.across.y * dx - half.across.x * dy),
          .v = scale * (half.along.x * dy - half.along.y * dx)};
}

std::optional<double> Ground::first_crossing(Vector3 origin, Vector3 direction) const noexcept {
  if (!covers(origin.x, origin.y)) return std::nullopt;
  const double gap = origin.z - height(origin.x, origin.y);
  if (gap == 0) return 0;
  const Along x{origin.x, direction.x};
  const Along y{origin.y, direction.y};
  const Along z{origin.z, direction.z};
  auto [i, j, u_begin, v_begin] = place(origin.x, origin.y);
  bool is_lower = u_begin >= v_begin;  // in the lower triangle of the cell, see add_to()
  double way = 0;
  // Walks from triangle to triangle. Within a triangle, every quantity is linear.
  while (true) {
    const auto [u, v] =
        bend_.empty() ? along_straight(i, j, x, y) : along_bend(i, j, is_lower, x, y);
    const double h00 = grid_height(i, j);
    const double h11 = grid_height(i + 1, j + 1);
    const double corner = is_lower ? grid_height(i + 1, j) : grid_height(i, j + 1);
    const Along ground = h00 + (is_lower ? (corner - h00) * u + (h11 - corner) * v
                                         : (corner - h00) * v + (h11 - corner) * u);
    const double meets = (gap > 0 ? z - ground : ground - z).zero();

    const double over_diagonal = (is_lower ? u - v : v - u).zero();
    const double over_u = (is_lower ? 1 + -u : u).zero();
    const double over_v = (is_lower ? v : 1 + -v).zero();
    const double leaves = std::min({over_diagonal, over_u, over_v});
    if (meets < never && meets <= leaves) return std::max(meets, way);  // max() undoes rounding
    if (leaves == never) return std::nullopt;
    way = std::max(way, leaves);

    if (leaves == over_u) {
      const std::size_t strips = grid_.x.size() - 1;
      const bool at_end = is_lower ? i + 1 == strips : i == 0;
      if (at_end && !bend_.closed()) return std::nullopt;
      i = (i + (is_lower ? 1 : strips - 1)) % strips;
    } else if (leaves == over_v) {
      if (is_lower ? j-- == 0 : ++j == grid_.t.size() - 1) return std::nullopt;
    }
    is_lower = !is_lower;
  }
}

Ground Ground::along(const Alignment& line) const {
  Ground bent = *this;
  // Land that is wider than the alignment allows would overlap in its curves.
  const auto is_far = [](double t) { return std::abs(t) > alignment_half_width; };
  if (std::ranges::any_of(grid_.t, is_far)) {
    throw std::invalid_argument("ground grid: too wide for an alignment");
  }
  std::vector<CrossLine> lines;
  for (std::size_t i = 0; i < grid_.x.size(); ++i) {
    const Stop at = line.at(grid_.x[i]);
    const double left_x = -std::sin(at.yaw);
    const double left_y = std::cos(at.yaw);
    lines.push_back({.x = at.x + grid_.offset[i] * left_x,
                     .y = at.y + grid_.offset[i] * left_y,
                     .left_x = left_x,
                     .left_y = left_y});
    const double height = line.height(grid_.x[i]);
    for (std::size_t j = 0; j < grid_.t.size(); ++j) {
      bent.heights_[i * grid_.t.size() + j] += height;
    }
  }
  bent.bend_ = CrossLines(std::move(lines), {grid_.t.front(), grid_.t.back()}, grid_.closed);
  return bent;
}

void Ground::add_to(Mesh& mesh, Interval x) const {
  const std::size_t columns = grid_.t.size();
  const auto first = static_cast<std::uint32_t>(mesh.vertices().size());
  const auto row_at = [&](double at) {
    return static_cast<std::size_t>(std::ranges::lower_bound(grid_.x, at) - grid_.x.begin());
  };
  const std::size_t begin = row_at(x.low);
  const std::size_t end = std::min(row_at(x.high), grid_.x.size() - 1);
  for (std::size_t i = begin; i <= end; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      const Vector3 corner = bend_.empty() ? Vector3{grid_.x[i], grid_.offset[i] + grid_.t[j], 0}
                                           : bend_[i].at(grid_.t[j]);
      mesh.add_vertex({corner.x, corner.y, grid_height(i, j)});
    }
  }
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t j = 0; j + 1 < columns; ++j) {
      const auto p00 = first + static_cast<std::uint32_t>((i - begin) * columns + j);
      const auto p10 = p00 + static_cast<std::uint32_t>(columns);
      const Surface& surface = surfaces_[i * (columns - 1) + j];
      mesh.add_triangle({p00, p10, p10 + 1}, surface);
      mesh.add_triangle({p00, p10 + 1, p00 + 1}, surface);
    }
  }
}

Frame frame_on_wheels(const Ground& ground, double x, double y, double yaw, double length,
                      double width) {
  const auto on_ground = [&](double ahead, double aside) {
    const double px = x + ahead * std::cos(yaw) - aside * std::sin(yaw);
    const double py = y + ahead * std::sin(yaw) + aside * std::cos(yaw);
    return Vector3{px, py, ground.height(px, py)};
  };
  Frame frame;
  frame.origin = on_ground(0, 0);
  frame.forward = normalized(on_ground(length / 2, 0) - on_ground(-length / 2, 0));
  const Vector3 across = on_ground(0, width / 2) - on_ground(0, -width / 2);
  frame.up = normalized(cross(frame.forward, across));
  frame.left = cross(frame.up, frame.forward);
  return frame;
}

void add_lines(std::vector<double>& lines, double begin, double end, double step) {
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / step - 1e-9)));
  for (int i = 0; i <= count; ++i) lines.push_back(begin + (end - begin) * i / count);
}

void finish_lines(std::vector<double>& lines) {
  constexpr double same = 1e-6;
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines, [](double a, double b) { return b - a < same; });
  lines.erase(repeated.begin(), repeated.end());
}

Ground cut_ground(GroundPlan plan) {
  GroundGrid grid{
      .x = std::move(plan.x), .offset = {}, .t = std::move(plan.t), .closed = plan.closed};
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  heights.reserve(grid.x.size() * grid.t.size());
  surfaces.reserve(grid.x.size() * grid.t.size());
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    grid.offset.push_back(plan.offset(grid.x[i]));
    for (const double t : grid.t) heights.push_back(plan.height(grid.x[i], t));
    if (i + 1 == grid.x.size()) break;
    const double middle_x = (grid.x[i] + grid.x[i + 1]) / 2;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(plan.surface(middle_x, (grid.t[j] + grid.t[j + 1]) / 2));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

float true_ground(const Ground& ground, const Frame& pose, Vector3 up, const float* xyz) {
  const Vector3 point{xyz[0], xyz[1], xyz[2]};
  if (point.x == 0 && point.y == 0 && point.z == 0) return std::numeric_limits<float>::quiet_NaN();
  const Vector3 world = pose.to_world(point);
  const double to_ground = world.z > ground.height(world.x, world.y) ? -1 : 1;
  const std::optional<double> way = ground.first_crossing(world, to_ground * up);
  return way ? static_cast<float>(point.z + to_ground * *way)
             : std::numeric_limits<float>::quiet_NaN();
}

std::vector<float> true_ground(const Ground& ground, const Frame& pose, Vector3 up,
                               std::span<const float> xyzi) {
  constexpr std::size_t columns = 4;
  std::vector<float> heights;
  heights.reserve(xyzi.size() / columns);
  for (std::size_t i = 0; i + columns <= xyzi.size(); i += columns) {
    heights.push_back(true_ground(ground, pose, up, &xyzi[i]));
  }
  return heights;
}

std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi) {
  return true_ground(ground, pose, pose.up, xyzi);
}

}  // namespace flagstone::sim

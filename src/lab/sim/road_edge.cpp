// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/road_edge.hpp"

#include <algorithm>
#include <span>

namespace flagstone::sim {

double Edge::height(double out) const noexcept {
  const std::span<const EdgeCorner> corners = kind->corners;
  double at = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const double length = corners[i].out - corners[i - 1].out;
    const double share = std::clamp((out - begin - corners[i - 1].out) / length, 0.0, 1.0);
    at += share * (corners[i].height - corners[i - 1].height);
  }
  return at;
}

const Surface& Edge::surface(double out) const noexcept {
  for (std::size_t i = 0; i < kind->between.size(); ++i) {
    if (out - begin < kind->corners[i + 1].out) return kind->between[i];
  }
  return kind->surface;
}

std::size_t EdgeRow::block_at(double x) const noexcept {
  const double last = static_cast<double>(blocks.size()) - 0.5;
  return static_cast<std::size_t>(std::clamp((x - x_begin) / block_length, 0.0, last));
}

double EdgeRow::height(double x, double out) const noexcept {
  const std::size_t block = block_at(x);
  const double own = blocks[block].height(out);
  const double from_begin = x - begin_of(block);
  const double from_end = block_length - from_begin;
  const bool at_begin = from_begin < from_end;
  if ((at_begin && block == 0) || (!at_begin && block + 1 == blocks.size())) return own;
  const double next = blocks[at_begin ? block - 1 : block + 1].height(out);
  // Each has a weight of one half on their border.
  const double share = std::min(0.5 + std::min(from_begin, from_end) / (2 * blend), 1.0);
  return share * own + (1 - share) * next;
}

std::vector<double> EdgeRow::corner_lines() const {
  std::vector<double> lines;
  for (const Edge& edge : blocks) {
    for (const EdgeCorner& corner : edge.kind->corners) lines.push_back(edge.begin + corner.out);
  }
  return lines;
}

std::vector<double> EdgeRow::blend_lines() const {
  std::vector<double> lines;
  for (std::size_t block = 1; block < blocks.size(); ++block) {
    lines.push_back(begin_of(block) - blend);
    lines.push_back(begin_of(block) + blend);
  }
  return lines;
}

std::vector<GroundStep> EdgeRow::steps(double side) const {
  std::vector<GroundStep> steps;
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    const Edge& edge = blocks[block];
    for (const MeasuredSlope& slope : edge.kind->slopes) {
      const EdgeCorner from = edge.kind->corners[slope.from];
      const EdgeCorner to = edge.kind->corners[slope.to];
      steps.push_back({.kind = slope.name,
                       .x_begin = begin_of(block) + blend,
                       .x_end = begin_of(block) + block_length - blend,
                       .y_begin = side * (edge.begin + from.out),
                       .y_end = side * (edge.begin + to.out),
                       .rise = to.height - from.height});
    }
  }
  return steps;
}

namespace {

constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface water{
    .semantic = SemanticClass::other_ground, .reflectivity = 0.04F, .mirror = 0.9F};
constexpr Surface masonry{.semantic = SemanticClass::other_structure, .reflectivity = 0.35F};

}  // namespace

std::vector<EdgeKind> dam_kinds(const DamMeasures& with) {
  const double foot = with.run * with.dam;
  const double berm = foot + 0.8;
  const double bottom = berm + 0.7 * with.ditch;
  const double up = bottom + with.bottom;
  constexpr double face = 0.06;  // tilted back, so that the ground stays a function of x and y
  const double below_wall = with.dam - with.drop;
  return {
      {.corners = {{0, 0}, {foot, -with.dam}}, .slopes = {{"dam down", 0, 1}}, .surface = grass},
      {.corners = {{0, 0},
                   {foot, -with.dam},
                   {berm, -with.dam},
                   {bottom, -with.dam - with.ditch},
                   {up, -with.dam - with.ditch},
                   {up + 0.7 * with.ditch, -with.dam}},
       .slopes = {{"dam down", 0, 1}, {"ditch down", 2, 3}, {"ditch up again", 4, 5}},
       .surface = grass,
       .between = {grass, grass, grass, with.wet ? water : grass, grass}},
      {.corners = {{0, 0},
                   {face, -with.drop},
                   {1.5, -with.drop},
                   {1.5 + with.run * below_wall, -with.dam}},
       .slopes = {{"retaining wall down", 0, 1}},
       .surface = grass,
       .between = {masonry, grass, grass}}};
}

std::vector<EdgeKind> cutting_kinds(const DamMeasures& with) {
  const double side = 1.2 * with.cut_ditch;
  const double bottom = side + 0.5;
  const double foot = bottom + side;
  constexpr double wall = 1;  // metres
  constexpr double face = 0.05;
  return {{.corners = {{0, 0},
                       {side, -with.cut_ditch},
                       {bottom, -with.cut_ditch},
                       {foot, 0},
                       {foot + with.run * with.cut, with.cut}},
           .slopes = {{"ditch down", 0, 1}, {"cutting up", 3, 4}},
           .surface = grass},
          {.corners = {{0, 0},
                       {side, -with.cut_ditch},
                       {bottom, -with.cut_ditch},
                       {foot, 0},
                       {foot + face, wall},
                       {foot + 1, wall},
                       {foot + 1 + with.run * (with.cut - wall), with.cut}},
           .slopes = {{"ditch down", 0, 1}, {"retaining wall up", 3, 4}},
           .surface = grass,
           .between = {grass, grass, grass, masonry, grass, grass}}};
}

}  // namespace flagstone::sim

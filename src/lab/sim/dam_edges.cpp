// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/dam_edges.hpp"

namespace flagstone::sim {
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
  constexpr double face = 0.06;  // leans back, so that the ground stays a function of x and y
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

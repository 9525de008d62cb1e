// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/barrier.hpp"

#include <array>

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::fence, .reflectivity = 0.35F};
constexpr Surface concrete{.semantic = SemanticClass::fence, .reflectivity = 0.38F};
constexpr Surface panel{.semantic = SemanticClass::fence, .reflectivity = 0.3F};
constexpr double piece = 4;  // straight, metres
constexpr double buried = 0.2;

}  // namespace

void add_guard_rail(Mesh& mesh, double t, Interval x, const RoadPlace& place) {
  add_beam(mesh, {.t = {t - 0.04, t + 0.04}, .z = {0.45, 0.76}}, x, piece, place, steel);
  for (double post = x.low; post <= x.high; post += piece) {
    add_beam(mesh, {.t = {t - 0.03, t + 0.03}, .z = {-buried, 0.7}}, {post - 0.06, post + 0.06},
             piece, place, steel);
  }
}

void add_concrete_barrier(Mesh& mesh, double t, Interval x, const RoadPlace& place) {
  add_extrusion(mesh,
                std::array{OutlinePoint{t - 0.3, -buried}, OutlinePoint{t + 0.3, -buried},
                           OutlinePoint{t + 0.3, 0.08}, OutlinePoint{t + 0.1, 0.9},
                           OutlinePoint{t - 0.1, 0.9}, OutlinePoint{t - 0.3, 0.08},
                           OutlinePoint{t - 0.3, -buried}},
                x, piece, place, concrete);
}

void add_noise_barrier(Mesh& mesh, double t, double height, Interval x, const RoadPlace& place) {
  constexpr double pitch = 5;
  add_beam(mesh, {.t = {t - 0.06, t + 0.06}, .z = {-buried, height}}, x, pitch, place, panel);
  for (double post = x.low; post <= x.high; post += pitch) {
    add_beam(mesh, {.t = {t - 0.12, t + 0.12}, .z = {-buried, height + 0.05}},
             {post - 0.1, post + 0.1}, pitch, place, concrete);
  }
}

}  // namespace flagstone::sim

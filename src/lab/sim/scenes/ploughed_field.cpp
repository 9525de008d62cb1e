// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/ground.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface soil{.semantic = SemanticClass::terrain, .reflectivity = 0.22F};
constexpr Surface packed_soil{.semantic = SemanticClass::terrain, .reflectivity = 0.27F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.42F};
constexpr Surface water{
    .semantic = SemanticClass::other_ground, .reflectivity = 0.04F, .mirror = 0.9F};

constexpr double half_length = 110;  // of the ground, metres
constexpr double half_width = 95;
constexpr double furrows_end = 50;  // grid lines follow single furrows up to this |y|, metres

// A ditch between grass: distances of its corners behind the edge of the field.
struct Ditch {
  double begin = 2, slope = 1, bottom = 0.8, depth = 0.9;  // metres
  [[nodiscard]] std::array<double, 4> corners() const noexcept {
    return {begin, begin + slope, begin + slope + bottom, begin + 2 * slope + bottom};
  }
  [[nodiscard]] double at(double beyond) const noexcept {
    const auto [down_begin, down_end, up_begin, up_end] = corners();
    const double down = std::clamp((beyond - down_begin) / (down_end - down_begin), 0.0, 1.0);
    const double up = std::clamp((beyond - up_begin) / (up_end - up_begin), 0.0, 1.0);
    return depth * (up - down);
  }
  [[nodiscard]] bool is_bottom(double beyond) const noexcept {
    return beyond > corners()[1] && beyond < corners()[2];
  }
};

// Furrows are along x; the vehicle crosses them at an angle. t is y.
struct Field {
  WindingPath path;
  std::vector<Wave> hills, swells;
  double pitch = 0.6;    // between furrows, metres
  double depth = 0.2;    // from crest to bottom
  double clods = 0.03;   // amplitude of the random roughness, metres
  double headland = 50;  // x at which the furrows end, metres; negative at the other end
  double edge_side = 1;  // +1: ditch and hedge are to the left
  double edge = 30;      // distance of the edge of the field on that side, metres
  bool wet = false;      // whether the ditch contains water
  Ditch ditch;
  double tramline = 5;     // y of one of the pairs of wheel tracks
  std::uint64_t seed = 0;  // for the clods

  static constexpr double tramline_spacing = 18;

  [[nodiscard]] double beyond_edge(double t) const noexcept { return edge_side * t - edge; }
  // 1 on the ploughed field, 0 on the headland and beyond the edge.
  [[nodiscard]] double ploughed(double x, double t) const noexcept {
    const double past_end = headland > 0 ? x - headland : headland - x;
    return (1 - smooth_step(-1.5, 0.5, past_end)) * (1 - smooth_step(-1.2, 0, beyond_edge(t)));
  }
  // 1 in the middle of a wheel track, along x in the field and along y on the headland.
  [[nodiscard]] double wheel_track(double x, double t) const noexcept {
    const double past_end = headland > 0 ? x - headland : headland - x;
    const double from_pair =
        past_end > 0 ? past_end - 4.5 : std::remainder(t - tramline, tramline_spacing);
    const double aside = std::abs(std::abs(from_pair) - 0.9) / 0.4;
    return std::max(0.0, 1 - aside * aside);
  }
  [[nodiscard]] double furrow(double t) const noexcept {
    const double at = t / pitch - std::floor(t / pitch);
    // Profile of a turned slice: up its front, down its back.
    const double rise = std::clamp((at - 0.1) / 0.45, 0.0, 1.0);
    const double fall = std::clamp((at - 0.6) / 0.4, 0.0, 1.0);
    return depth * (rise - fall - 0.5);
  }
  [[nodiscard]] double clod(double x, double t) const noexcept {
    const auto place = static_cast<std::uint64_t>(std::llround((x + 1000) * 100)) * 1'000'003U +
                       static_cast<std::uint64_t>(std::llround((t + 1000) * 100));
    return Random::stream(seed, place).uniform(-1, 1);
  }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double worked = ploughed(x, t);
    const double loose = worked * (1 - 0.8 * wheel_track(x, t));
    double land = sum_at(hills, x, t) + sum_at(swells, x, t) - 0.06 * wheel_track(x, t);
    if (std::abs(t) < furrows_end) land += loose * furrow(t);
    land += clods * clod(x, t) * (0.25 + 0.75 * loose) * (beyond_edge(t) > 0 ? 0.4 : 1);
    return land + ditch.at(beyond_edge(t));
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    if (wet && ditch.is_bottom(beyond_edge(t))) return water;
    if (beyond_edge(t) > 0) return grass;
    return wheel_track(x, t) > 0.3 ? packed_soil : soil;
  }
};

Field draw_field(Random& random) {
  Field field;
  field.path = {.swing = random.uniform(-2, 2),
                .swing_length = random.uniform(80, 140),
                .slope = (random.chance(0.5) ? 1 : -1) * random.uniform(0.2, 0.55)};
  draw_waves(field.hills, 4, {0.2, 0.7}, {50, 120}, random);
  draw_waves(field.swells, 5, {0.02, 0.06}, {5, 14}, random);
  field.pitch = random.uniform(0.4, 0.8);
  field.depth = random.uniform(0.15, std::min(0.25, 0.4 * field.pitch));
  field.clods = random.uniform(0.02, 0.04);
  field.headland = (random.chance(0.5) ? 1 : -1) * random.uniform(42, 60);
  field.edge_side = random.chance(0.5) ? 1 : -1;
  field.edge = random.uniform(27, 34);
  field.wet = random.chance(0.5);
  field.ditch = {.begin = random.uniform(1, 2.5),
                 .slope = random.uniform(0.8, 1.6),
                 .bottom = random.uniform(0.6, 1.2),
                 .depth = random.uniform(0.6, 1.2)};
  field.tramline = random.uniform(-9, 9);
  field.seed = random.bits();
  return field;
}

// Grid lines at the start, on the slope and at the crest of each furrow; fewer beyond 32 m.
std::vector<double> furrow_lines(const Field& field) {
  constexpr double fine = 32;
  std::vector<double> lines;
  const int last = static_cast<int>(std::floor(furrows_end / field.pitch));
  for (int furrow = -last; furrow < last; ++furrow) {
    const double begin = furrow * field.pitch;
    lines.push_back(begin);
    lines.push_back(begin + 0.58 * field.pitch);
    if (std::abs(begin) < fine) lines.push_back(begin + 0.1 * field.pitch);
  }
  for (const double corner : field.ditch.corners()) {
    lines.push_back(field.edge_side * (field.edge + corner));
  }
  return lines;
}

Ground make_field(const Field& field) {
  std::vector<double> across = furrow_lines(field);
  add_lines(across, -half_width, -furrows_end, 1.5);
  add_lines(across, furrows_end, half_width, 1.5);
  finish_lines(across);
  return cut_ground(
      {.x = lines_in_bands(-half_length, std::array{LineBand{-48, 1.4}, LineBand{48, 0.45},
                                                    LineBand{half_length, 1.4}}),
       .t = std::move(across),
       .offset = [](double) { return 0.0; },
       .height = [&](double x, double t) { return field.height(x, t); },
       .surface = [&](double x, double t) { return field.surface(x, t); }});
}

Mesh furnish_field(const Field& field, const Ground& ground, Random random) {
  Mesh mesh;
  const double behind_ditch = field.edge + field.ditch.corners()[3];
  // A hedge with gaps and trees behind the ditch.
  constexpr double piece = 9;
  for (double x = -95; x < 95; x += piece) {
    if (random.chance(0.2)) continue;
    const double y = field.edge_side * (behind_ditch + 1.5);
    add_hedge(mesh, ground,
              {.x0 = x,
               .y0 = y,
               .x1 = x + piece,
               .y1 = y,
               .width = random.uniform(1, 1.6),
               .height = random.uniform(1.3, 2.2)},
              random);
  }
  for (double x = -90; x < 90; x += random.uniform(12, 30)) {
    add_tree(mesh, ground, x, field.edge_side * (behind_ditch + random.uniform(1.5, 4)), random);
  }
  for (int tuft = 0; tuft < 1500; ++tuft) {
    const double beyond = random.uniform(0, behind_ditch - field.edge + 6);
    add_tuft(mesh, ground, random.uniform(-60, 60), field.edge_side * (field.edge + beyond),
             random);
  }
  // Weeds and straw left by the plough.
  scatter(field.path, {.x = {-60, 60}, .from_path = {0.4, 20}}, 0.12, random,
          [&](double x, double y) {
            if (field.beyond_edge(y) < 0) add_tuft(mesh, ground, x, y, random);
          });
  return mesh;
}

// A tractor that ploughs along the furrows, away from the path.
struct Ploughing {
  double x = 0, y = 0;  // at stop 0, metres
  double speed = 0;     // along x, m/s
  int shares = 4;
  std::uint64_t look = 0;
};

Ploughing draw_ploughing(const Field& field, Random& random) {
  const double x = random.uniform(-25, 25);
  const double side = -field.edge_side;  // the other side has the ditch
  const double away = side * field.path.slope > 0 ? -1 : 1;
  return {.x = x,
          .y = field.path.y(x) + side * random.uniform(13, 20),
          .speed = away * random.uniform(1.8, 2.8),
          .shares = 3 + static_cast<int>(random.uniform(0, 3)),
          .look = random.bits()};
}

Mesh tractor_at(const Ploughing& ploughing, const Ground& ground, double seconds) {
  Mesh mesh;
  Random look(ploughing.look);
  constexpr double wheelbase = 2.4;
  constexpr double track = 1.9;
  const double x = ploughing.x + seconds * ploughing.speed;
  const double yaw = ploughing.speed < 0 ? std::numbers::pi : 0;
  add_tractor(mesh, frame_on_wheels(ground, x, ploughing.y, yaw, wheelbase, track),
              ploughing.shares, look);
  mesh.set_motion(0, Motion::now);
  return mesh;
}

}  // namespace

Landscape ploughed_field(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Field field = draw_field(random);
  Ground ground = make_field(field);
  std::vector<Stop> route = wander_along([&](double x) { return field.path.at(x); }, random);
  const Ploughing ploughing = draw_ploughing(field, random);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [field = std::move(field), random](
                         const Ground& on,
                         const Stretch& /*whole*/) { return furnish_field(field, on, random); },
          .moving = [ploughing](const Ground& on,
                                double seconds) { return tractor_at(ploughing, on, seconds); }};
}

}  // namespace flagstone::sim

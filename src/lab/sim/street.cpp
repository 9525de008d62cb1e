// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/street.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/buildings.hpp"
#include "lab/sim/furniture.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/people.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {

namespace {

StreetSide plan_side(Random& random, bool parking) {
  StreetSide side;
  side.parking_width = parking ? random.uniform(2, 2.3) : 0;
  side.kerb_height = random.uniform(0.07, 0.14);
  side.sidewalk_width = random.uniform(1.6, 2.8);
  side.land_slope = random.uniform(-0.03, 0.06);
  side.bank_height = random.chance(0.4) ? random.uniform(0.2, 0.8) : 0;
  return side;
}

StreetShape plan_shape(Random& random) {
  StreetShape shape;
  shape.half_width = random.uniform(2.9, 3.7);
  shape.grade = random.uniform(-0.03, 0.03);
  const double steeper = random.uniform(0.02, 0.07);
  const double change = random.chance(0.5) ? steeper : -steeper;
  shape.grade_changes = {{.change = change, .x = random.uniform(20, 45)}};
  shape.bend_amplitude = random.uniform(-3, 3);
  shape.crown = random.uniform(0.04, 0.09);
  shape.cross_fall = random.uniform(-0.02, 0.02);
  const bool parking_left = random.chance(0.6);
  shape.sides[static_cast<std::size_t>(Side::left)] = plan_side(random, parking_left);
  shape.sides[static_cast<std::size_t>(Side::right)] =
      plan_side(random, !parking_left || random.chance(0.5));
  for (int wave = 0; wave < 3; ++wave) {
    Undulation undulation;
    undulation.amplitude = random.uniform(0.03, 0.08);
    undulation.wave_x = 2 * std::numbers::pi / random.uniform(9, 25);
    undulation.wave_y = 2 * std::numbers::pi / random.uniform(9, 25);
    undulation.phase = random.uniform(0, 2 * std::numbers::pi);
    shape.undulations.push_back(undulation);
  }
  return shape;
}

Plot plan_plot(Random& random, Side side, double x_begin) {
  Plot plot;
  plot.side = side;
  plot.house.width = random.uniform(8, 16);
  plot.house.depth = random.uniform(8, 11);
  plot.house.eaves = random.uniform(3.2, 8.5);
  plot.x_begin = x_begin;
  plot.x_end = x_begin + plot.house.width;
  plot.setback = random.uniform(2.5, 9);
  plot.built = random.chance(0.75);
  const double drawn = random.uniform();
  if (drawn < 0.3) {
    plot.boundary = Boundary::fence;
  } else if (drawn < 0.6) {
    plot.boundary = Boundary::hedge;
  }
  return plot;
}

}  // namespace

StreetPlan plan_street(Random& random, const Extent& extent) {
  StreetPlan plan{.shape = plan_shape(random), .plots = {}, .furnishing = {}, .extent = extent};
  plan.shape.extend(extent);
  for (const Side side : {Side::right, Side::left}) {
    double x = plan.shape.length.low + random.uniform(5, 15);
    while (x < plan.shape.length.high - 25) {
      const Plot plot = plan_plot(random, side, x);
      const double gap = random.uniform(3, 9);
      plan.plots.push_back(plot);
      x = plot.x_end + gap;
      if (random.chance(0.6)) {
        plan.shape.sides[static_cast<std::size_t>(side)].driveways.push_back(
            {.x = plot.x_end + gap / 2, .width = 2.6});
      }
    }
  }
  return plan;
}

namespace {

constexpr double half_turn = std::numbers::pi;

// Adds objects to the ground of one plan. "out" is the distance from the centre line on either
// side.
class Furnisher {
 public:
  Furnisher(const StreetPlan& plan, const Ground& ground, const Stretch& stretch, Random& random)
      : shape_(plan.shape),
        furnishing_(plan.furnishing),
        ground_(ground),
        stretch_(stretch),
        random_(random) {
    constexpr double everything = 200;
    const Interval here = stretch.reach(everything);
    for (const Plot& plot : plan.plots) {
      if (plot.x_begin < here.low || plot.x_begin >= here.high) continue;
      if (plot.built) build_house(plot);
      plant_garden(plot);
      bound_garden(plot);
    }
    for (const Side side : {Side::right, Side::left}) {
      park_cars(side);
      line_sidewalk(side);
      plant_behind(side);
    }
    if (furnishing_.traffic) drive_cars();
  }

  Mesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] double y_at(double x, Side side, double out) const {
    return shape_.centre_line(x) + sign(side) * out;
  }
  // An upright frame on the ground, with its x axis along the street, turned by `turn` radians.
  [[nodiscard]] Frame upright_at(double x, Side side, double out, double turn) const {
    const double y = y_at(x, side, out);
    return upright_frame({x, y, ground_.height(x, y)}, shape_.heading(x) + turn);
  }
  [[nodiscard]] bool on_driveway(Side side, double x, double margin) const {
    return std::ranges::any_of(shape_.side(side).driveways, [&](const Driveway& driveway) {
      return std::abs(x - driveway.x) < driveway.width / 2 + margin;
    });
  }

  void build_house(const Plot& plot) {
    const double middle = (plot.x_begin + plot.x_end) / 2;
    const double out = shape_.land_begin(plot.side) + plot.setback;
    // The y axis of a house points into the house, away from the street.
    const double turn = plot.side == Side::left ? 0 : half_turn;
    add_house(mesh_, upright_at(middle, plot.side, out, turn), plot.house, random_);
  }

  void plant_garden(const Plot& plot) {
    constexpr double green_depth = 18;
    const double depth = plot.built ? plot.setback : green_depth;
    const double area = depth * (plot.x_end - plot.x_begin);
    const double begin = shape_.land_begin(plot.side);
    // A random position with this distance from the sidewalk and the house.
    const auto place = [&](double margin) {
      const double x = random_.uniform(plot.x_begin, plot.x_end);
      const double out = begin + random_.uniform(margin, std::max(margin, depth - margin));
      return Vector3{x, y_at(x, plot.side, out), 0};
    };
    const auto repeat = [&](double per_square_metre, double margin, auto plant) {
      const int count = static_cast<int>(per_square_metre * area + random_.uniform());
      for (int i = 0; i < count; ++i) {
        const Vector3 at = place(margin);
        plant(mesh_, ground_, at.x, at.y, random_);
      }
    };
    const Interval tufts = furnishing_.tufts;
    repeat(furnishing_.trees, 1.2, add_tree);
    repeat(furnishing_.bushes, 0.8, add_bush);
    repeat(random_.uniform(tufts.low, tufts.high), 0.1, add_tuft);
    if (furnishing_.ground_cover > 0) repeat(furnishing_.ground_cover, 1, add_ground_cover);
  }

  void bound_garden(const Plot& plot) {
    const double out = shape_.land_begin(plot.side) + 0.4;
    const double gate = plot.x_begin + random_.uniform(0.3, 0.7) * (plot.x_end - plot.x_begin);
    for (const auto& [x0, x1] :
         {std::pair{plot.x_begin, gate - 0.6}, std::pair{gate + 0.6, plot.x_end}}) {
      const double y0 = y_at(x0, plot.side, out);
      const double y1 = y_at(x1, plot.side, out);
      if (plot.boundary == Boundary::fence) {
        add_fence(mesh_, ground_, {.x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1});
      } else if (plot.boundary == Boundary::hedge) {
        add_hedge(mesh_, ground_, {.x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1}, random_);
      }
    }
  }

  void add_car_at(double x, Side side, double out, double turn) {
    constexpr double wheelbase = 2.6;
    constexpr double track = 1.5;
    add_car(
        mesh_,
        frame_on_wheels(ground_, x, y_at(x, side, out), shape_.heading(x) + turn, wheelbase, track),
        random_);
  }

  void park_cars(Side side) {
    const double width = shape_.side(side).parking_width;
    if (width == 0) return;
    const bool bays = furnishing_.parking[static_cast<std::size_t>(side)] == Parking::bays;
    const double place = bays ? widest_car : longest_car;
    const double quarter = bays ? (side == Side::left ? 1 : -1) * half_turn / 2 : 0;
    const Interval row = stretch_.reach(44, place / 2);
    double x = row.low + random_.uniform(0, 5);
    while (x < row.high) {
      if (random_.chance(furnishing_.occupied) && !on_driveway(side, x, place / 2)) {
        const double out = shape_.half_width + width / 2 + random_.uniform(-0.1, 0.1);
        const double askew = random_.uniform(-0.03, 0.03);
        const bool against = (bays || side == Side::left) && random_.chance(0.7);
        add_car_at(x, side, out, quarter + askew + (against ? half_turn : 0));
      }
      x += place + random_.uniform(furnishing_.parking_gap.low, furnishing_.parking_gap.high);
    }
  }

  void line_sidewalk(Side side) {
    const Interval row = stretch_.reach(54, 2);
    double x = row.low + random_.uniform(0, 20);
    while (x < row.high) {
      if (!on_driveway(side, x, 0.5)) stand_at_kerb(x, side);
      x += random_.uniform(8, 14);
    }
    for (int person = 0; person < 3; ++person) {
      const double at = random_.uniform(stretch_.x.low + 11, stretch_.x.high - 6);
      const double out = shape_.sidewalk_begin(side) +
                         random_.uniform(0.4, 0.7) * shape_.side(side).sidewalk_width;
      add_person(mesh_, upright_at(at, side, out, random_.chance(0.5) ? 0 : half_turn), random_);
    }
  }

  // Adds a lamp post, a sign, a street tree or nothing.
  void stand_at_kerb(double x, Side side) {
    const double out = shape_.sidewalk_begin(side) + 0.35;
    const double drawn = random_.uniform();
    if (drawn < 0.3) {
      const double to_street = side == Side::left ? -half_turn / 2 : half_turn / 2;
      add_lamp_post(mesh_, upright_at(x, side, out, to_street));
    } else if (drawn < 0.5) {
      // Signs face oncoming traffic, which drives along +x on the right.
      const double facing = side == Side::right ? half_turn : 0;
      add_traffic_sign(mesh_, upright_at(x, side, out, facing));
    } else if (drawn < 0.7) {
      const double from_path = std::abs(sign(side) * (out + 0.2) - furnishing_.path);
      if (from_path < furnishing_.crown_distance) return;
      add_tree(mesh_, ground_, x, y_at(x, side, out + 0.2), random_);
    }
  }

  // Trees behind the houses fill the view through the gaps.
  void plant_behind(Side side) {
    constexpr double behind_houses = 20;
    const Interval row = stretch_.reach(69);
    double x = row.low;
    while (x < row.high) {
      const double out = shape_.land_begin(side) + random_.uniform(behind_houses, 35);
      add_tree(mesh_, ground_, x, y_at(x, side, out), random_);
      x += random_.uniform(5, 11);
    }
  }

  void drive_cars() {
    const double lane = shape_.half_width / 2;
    const double free = furnishing_.free_lane;
    add_car_at(free + random_.uniform(14, 30), Side::right, lane, 0);
    add_car_at(random_.uniform(8, 40), Side::left, lane, half_turn);
    add_car_at(random_.uniform(-45, -15) - free, Side::right, lane, 0);
  }

  const StreetShape& shape_;
  const Furnishing& furnishing_;
  const Ground& ground_;
  const Stretch& stretch_;
  Random& random_;
  Mesh mesh_;
};

}  // namespace

Mesh furnish(const StreetPlan& plan, const Ground& ground, const Stretch& stretch, Random& random) {
  return Furnisher(plan, ground, stretch, random).take();
}

Landscape drive_street(StreetPlan plan, Random random) {
  plan.furnishing.free_lane = half_drive + longest_car;
  plan.furnishing.crown_distance = 3.3;  // more than the radius of the largest crown
  Ground ground = make_ground(plan.shape);
  const StreetShape& shape = plan.shape;
  std::vector<Stop> route = wander_along(
      [&](double x) {
        const double y = shape.centre_line(x) + plan.furnishing.path;
        return Stop{.x = x, .y = y, .yaw = shape.heading(x)};
      },
      random, plan.extent);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [plan = std::move(plan), random](const Ground& on, const Stretch& stretch) {
            Random own = stretch.stream(random);
            return furnish(plan, on, stretch, own);
          }};
}

Scene make_street(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  const StreetPlan plan = plan_street(random);
  Ground ground = make_ground(plan.shape);
  Mesh objects = furnish(plan, ground, {}, random);
  return {std::move(ground), std::move(objects)};
}

}  // namespace flagstone::sim

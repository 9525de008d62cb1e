// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/street_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace flagstone::sim {
namespace {

constexpr double kerb_face_width = 0.02;  // a kerb leans back a little; keeps the height a function
constexpr double gutter_fall = 0.02;      // of the parking strip, metres a metre outward
constexpr double sidewalk_rise = 0.02;    // metres a metre outward
constexpr double driveway_kerb_share = 0.2;  // of the kerb that stays at a driveway
constexpr double driveway_ramp = 0.6;        // metres on either side of it
constexpr double bank_begin = 0.5;           // metres behind the sidewalk
constexpr double bank_width = 4;
constexpr double undulation_begin = 5;  // metres behind the sidewalk until it has its full height
constexpr double dash_period = 6;       // of the centre marking, half of it painted

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.24F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface cobbles{.semantic = SemanticClass::parking, .reflectivity = 0.34F};
constexpr Surface slabs{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface gravel{.semantic = SemanticClass::other_ground, .reflectivity = 0.33F};
constexpr Surface lawn{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};

double smooth_step(double x) noexcept {
  const double clamped = std::clamp(x, 0.0, 1.0);
  return clamped * clamped * (3 - 2 * clamped);
}

// 1 within a driveway, 0 well outside of all.
double driveway_share(const StreetSide& side, double x) noexcept {
  double share = 0;
  for (const Driveway& driveway : side.driveways) {
    const double outside = std::abs(x - driveway.x) - driveway.width / 2;
    share = std::max(share, std::clamp(1 - outside / driveway_ramp, 0.0, 1.0));
  }
  return share;
}

// Height along the centre line, 0 at x = 0: a grade that turns smoothly into others.
double longitudinal_height(const StreetShape& shape, double x) noexcept {
  double height = shape.grade * x;
  for (const GradeChange& curve : shape.grade_changes) {
    const auto bent = [&](double at) {
      return curve.length * std::log1p(std::exp((at - curve.x) / curve.length));
    };
    height += curve.change * (bent(x) - bent(0));
  }
  return height;
}

double land_height(const StreetShape& shape, const StreetSide& side, double x, double t,
                   double behind) noexcept {
  double height =
      side.land_slope * behind + side.bank_height * smooth_step((behind - bank_begin) / bank_width);
  for (const Undulation& wave : shape.undulations) {
    height += wave.amplitude * smooth_step(behind / undulation_begin) *
              std::sin(wave.wave_x * x + wave.wave_y * t + wave.phase);
  }
  return height;
}

// Height across the street relative to the centre line, without the cross-fall.
double lateral_height(const StreetShape& shape, Side which, double x, double t) noexcept {
  const StreetSide& side = shape.side(which);
  const double out = std::abs(t);
  const double on_road = std::min(out / shape.half_width, 1.0);
  double height = -shape.crown * on_road * on_road;
  height -= gutter_fall * std::clamp(out - shape.half_width, 0.0, side.parking_width);

  // At a driveway the kerb is low and the sidewalk makes up for it on the way out.
  const double on_sidewalk =
      std::clamp(out - shape.sidewalk_begin(which), 0.0, side.sidewalk_width);
  const double lowered =
      (1 - driveway_kerb_share) * driveway_share(side, x) * (1 - on_sidewalk / side.sidewalk_width);
  height += side.kerb_height * (1 - lowered) *
            std::clamp((out - shape.kerb(which)) / kerb_face_width, 0.0, 1.0);
  height += sidewalk_rise * on_sidewalk;
  const double behind = out - shape.land_begin(which);
  return behind > 0 ? height + land_height(shape, side, x, t, behind) : height;
}

// Adds lines from `begin` to `end` inclusive, at most `step` apart.
void add_lines(std::vector<double>& lines, double begin, double end, double step) {
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / step - 1e-9)));
  for (int i = 0; i <= count; ++i) lines.push_back(begin + (end - begin) * i / count);
}

// Sorts, and drops lines that are so near to another one that only rounding tells them apart.
void finish_lines(std::vector<double>& lines) {
  constexpr double same = 1e-6;
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines, [](double a, double b) { return b - a < same; });
  lines.erase(repeated.begin(), repeated.end());
}

std::vector<double> lines_across(const StreetShape& shape) {
  constexpr double road_step = 0.4;
  constexpr double bank_step = 0.25;
  constexpr double land_step = 0.8;
  std::vector<double> lines;
  for (const Side which : {Side::right, Side::left}) {
    const double bank_end = shape.land_begin(which) + bank_begin + bank_width;
    std::vector<double> outward;
    add_lines(outward, 0, shape.marking_width / 2, road_step);
    add_lines(outward, shape.marking_width / 2, shape.half_width, road_step);
    add_lines(outward, shape.half_width, shape.kerb(which), road_step);
    add_lines(outward, shape.kerb(which), shape.sidewalk_begin(which), road_step);
    add_lines(outward, shape.sidewalk_begin(which), shape.land_begin(which), road_step);
    add_lines(outward, shape.land_begin(which), bank_end, bank_step);
    add_lines(outward, bank_end, shape.land_end(which), land_step);
    for (const double out : outward) lines.push_back(sign(which) * out);
  }
  finish_lines(lines);
  return lines;
}

std::vector<double> lines_along(const StreetShape& shape) {
  constexpr double step = 0.5;  // divides half of the dash period
  std::vector<double> lines;
  add_lines(lines, -shape.half_length, shape.half_length, step);
  for (const StreetSide& side : shape.sides) {
    for (const Driveway& driveway : side.driveways) {
      for (const double end : {-1.0, 1.0}) {
        lines.push_back(driveway.x + end * driveway.width / 2);
        lines.push_back(driveway.x + end * (driveway.width / 2 + driveway_ramp));
      }
    }
  }
  finish_lines(lines);
  return lines;
}

}  // namespace

double StreetShape::sidewalk_begin(Side which) const noexcept {
  return kerb(which) + kerb_face_width;
}

double StreetShape::centre_line(double x) const noexcept {
  return bend_amplitude / 2 * (1 - std::cos(2 * std::numbers::pi * x / bend_length));
}

double StreetShape::heading(double x) const noexcept {
  const double wave = 2 * std::numbers::pi / bend_length;
  return std::atan(bend_amplitude / 2 * wave * std::sin(wave * x));
}

double StreetShape::height(double x, double t) const noexcept {
  const Side which = t < 0 ? Side::right : Side::left;
  const double tilted = std::clamp(t, -land_begin(Side::right), land_begin(Side::left));
  return longitudinal_height(*this, x) + cross_fall * tilted + lateral_height(*this, which, x, t);
}

Surface StreetShape::surface(double x, double t) const noexcept {
  const Side which = t < 0 ? Side::right : Side::left;
  const double out = std::abs(t);
  if (out < marking_width / 2) {
    const double in_period = x / dash_period - std::floor(x / dash_period);
    return in_period < 0.5 ? paint : asphalt;
  }
  if (out < half_width) return asphalt;
  if (out < kerb(which)) return cobbles;
  if (out < land_begin(which)) return slabs;
  return driveway_share(side(which), x) == 1 ? gravel : lawn;
}

Ground make_ground(const StreetShape& shape) {
  GroundGrid grid{.x = lines_along(shape), .offset = {}, .t = lines_across(shape)};
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  heights.reserve(grid.x.size() * grid.t.size());
  surfaces.reserve(grid.x.size() * grid.t.size());
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    grid.offset.push_back(shape.centre_line(grid.x[i]));
    for (const double t : grid.t) heights.push_back(shape.height(grid.x[i], t));
    if (i + 1 == grid.x.size()) break;
    const double middle_x = (grid.x[i] + grid.x[i + 1]) / 2;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(shape.surface(middle_x, (grid.t[j] + grid.t[j + 1]) / 2));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

}  // namespace flagstone::sim

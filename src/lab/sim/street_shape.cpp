// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/street_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/sim/ground.hpp"

namespace flagstone::sim {
namespace {

constexpr double kerb_face_width = 0.02;     // kerbs are tilted back: height is a function of t
constexpr double gutter_fall = 0.02;         // of the parking strip outward, m/m
constexpr double sidewalk_rise = 0.02;       // outward, m/m
constexpr double driveway_kerb_share = 0.2;  // fraction of the kerb height at a driveway
constexpr double driveway_ramp = 0.6;        // metres on each side of a driveway
constexpr double bank_begin = 0.5;           // metres behind the sidewalk
constexpr double bank_width = 4;
constexpr double undulation_begin = 5;  // metres behind the sidewalk until it has its full height
constexpr double dash_period = 6;       // of the centre marking, half of it painted
constexpr double zebra_stripe = 0.5;    // metres across the street, with equal gaps

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

// 1 within `width` metres around `middle`, 0 well outside.
double share_of(double middle, double width, double x) noexcept {
  const double outside = std::abs(x - middle) - width / 2;
  return std::clamp(1 - outside / driveway_ramp, 0.0, 1.0);
}

double driveway_share(const StreetSide& side, double x) noexcept {
  double share = 0;
  for (const Driveway& driveway : side.driveways) {
    share = std::max(share, share_of(driveway.x, driveway.width, x));
  }
  return share;
}

double crossing_share(const StreetShape& shape, double x) noexcept {
  double share = 0;
  for (const double crossing : shape.crossings) {
    share = std::max(share, share_of(crossing, crossing_width, x));
  }
  return share;
}

// Height along the centre line, 0 at x = 0, with smooth changes of grade.
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

  // At a driveway or a crossing the kerb is low, and the sidewalk rises by the difference.
  const double on_sidewalk =
      std::clamp(out - shape.sidewalk_begin(which), 0.0, side.sidewalk_width);
  const double low_kerb = std::max(driveway_share(side, x), crossing_share(shape, x));
  const double lowered =
      (1 - driveway_kerb_share) * low_kerb * (1 - on_sidewalk / side.sidewalk_width);
  height += side.kerb_height * (1 - lowered) *
            std::clamp((out - shape.kerb(which)) / kerb_face_width, 0.0, 1.0);
  height += sidewalk_rise * on_sidewalk;
  const double behind = out - shape.land_begin(which);
  return behind > 0 ? height + land_height(shape, side, x, t, behind) : height;
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
    for (double out = 0; !shape.crossings.empty() && out < shape.half_width; out += zebra_stripe) {
      outward.push_back(out);
    }
    for (const double out : outward) lines.push_back(sign(which) * out);
  }
  finish_lines(lines);
  return lines;
}

std::vector<double> lines_along(const StreetShape& shape) {
  constexpr double step = 0.5;  // divides half of the dash period
  std::vector<double> lines;
  add_lines(lines, shape.length.low, shape.length.high, step);
  const auto add_ends = [&](double middle, double width) {
    for (const double end : {-1.0, 1.0}) {
      lines.push_back(middle + end * width / 2);
      lines.push_back(middle + end * (width / 2 + driveway_ramp));
    }
  };
  for (const StreetSide& side : shape.sides) {
    for (const Driveway& driveway : side.driveways) add_ends(driveway.x, driveway.width);
  }
  for (const double crossing : shape.crossings) add_ends(crossing, crossing_width);
  finish_lines(lines);
  return lines;
}

}  // namespace

double StreetShape::sidewalk_begin(Side which) const noexcept {
  return kerb(which) + kerb_face_width;
}

void StreetShape::extend(const Extent& extent) {
  constexpr double beyond = 74;  // metres
  length = extent.reach(beyond);
  closed = extent.closed;
  if (!extent.is_long()) return;
  grade = 0;
  grade_changes.clear();
  bend_length = extent.fitted_length(bend_length);
  for (Undulation& wave : undulations) wave.wave_x = extent.fitted(wave.wave_x);
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
  if (out < half_width && crossing_share(*this, x) == 1) {
    return static_cast<int>(out / zebra_stripe) % 2 == 0 ? paint : asphalt;
  }
  if (out < marking_width / 2) {
    const double in_period = x / dash_period - std::floor(x / dash_period);
    return in_period < 0.5 ? paint : asphalt;
  }
  if (out < half_width) return asphalt;
  if (out < kerb(which)) return cobbles;
  if (out < land_begin(which)) return slabs;
  if (driveway_share(side(which), x) == 1) return gravel;
  return paved_land ? slabs : lawn;
}

Ground make_ground(const StreetShape& shape) {
  return cut_ground({.x = lines_along(shape),
                     .t = lines_across(shape),
                     .offset = [&](double x) { return shape.centre_line(x); },
                     .height = [&](double x, double t) { return shape.height(x, t); },
                     .surface = [&](double x, double t) { return shape.surface(x, t); },
                     .closed = shape.closed});
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/ground_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone::mount {
namespace {

/// Step between the directions of the first test: tangent of 5 degrees. At a distance of 6 m this
/// is half a metre of height, the thickness of a level.
constexpr float direction_step = 0.0875f;

/// Thickness of a slice, metres. A level consists of two slices and overlaps the levels above and
/// below.
constexpr float slice = 0.25f;

/// Penalty for points below a level, relative to the weight of points in it.
constexpr float cost_below = 2;

/// Maximum number of points in the first test of every direction. The refinement uses all points.
constexpr std::size_t few = 2048;
constexpr std::size_t most_candidates = 4;

/// Factor for the score of a plane with this normal, 0 to 1. With a `lean_cost` of 45 it is 0.9 at
/// 3 degrees from the expected up direction, 0.5 at 8.5 degrees and 0.25 at 14.5 degrees.
float belief_in(const Vector3f& up, float lean_cost) noexcept {
  const float cosine_square = up[2] * up[2];
  return cosine_square / (cosine_square + lean_cost * (1 - cosine_square));
}

/// Distance from the plane within which each round of the refinement uses points, metres. In later
/// rounds the distance above the plane is halved, because objects are always above the ground.
constexpr std::array<float, 6> gates = {0.6f, 0.45f, 0.3f, 0.22f, 0.15f, 0.15f};
constexpr float gate_per_metre = 0.015f;  // m/m
constexpr std::size_t one_sided_from = 2;

/// The first rounds fit a plane; rounds from this one also fit quadratic terms, for crests and
/// dips.
constexpr std::size_t bends_from = 3;

/// Priors for level and even ground, because points on a line or far to one side do not determine
/// the ground below the vehicle. In m^2 for the slope and m^4 for the quadratic terms.
constexpr double level_prior = 0.3;
constexpr double even_prior = 100;

/// z = c + a x + b y + xx x^2 + xy x y + yy y^2 by weighted least squares, in double precision.
class GroundFit {
 public:
  static constexpr std::size_t terms = 6;
  using Terms = std::array<double, terms>;

  void add(double weight, double x, double y, double z) noexcept {
    const Terms term = {1, x, y, x * x, x * y, y * y};
    for (std::size_t row = 0; row < terms; ++row) {
      const double weighted = weight * term[row];
      for (std::size_t column = 0; column <= row; ++column) {
        squares_[row][column] += weighted * term[column];
      }
      right_[row] += weighted * z;
    }
  }

  /// Solves for the first `count` terms, 3 or 6; the others are 0. Returns nothing without any
  /// weight.
  [[nodiscard]] std::optional<Terms> solve(std::size_t count) const noexcept {
    const double weight = squares_[0][0];
    if (!(weight > 0)) return {};
    // Cholesky decomposition. With the priors, the matrix is positive definite.
    std::array<Terms, terms> root = squares_;
    const Terms prior = {1e-9, level_prior, level_prior, even_prior, even_prior, even_prior};
    Terms solution = right_;
    for (std::size_t row = 0; row < count; ++row) {
      root[row][row] += weight * prior[row];
      for (std::size_t column = 0; column <= row; ++column) {
        double rest = root[row][column];
        for (std::size_t k = 0; k < column; ++k) rest -= root[row][k] * root[column][k];
        if (column < row) {
          root[row][column] = rest / root[column][column];
        } else {
          if (!(rest > 0)) return {};
          root[row][row] = std::sqrt(rest);
        }
      }
      for (std::size_t k = 0; k < row; ++k) solution[row] -= root[row][k] * solution[k];
      solution[row] /= root[row][row];
    }
    for (std::size_t row = count; row-- > 0;) {
      for (std::size_t k = row + 1; k < count; ++k) solution[row] -= root[k][row] * solution[k];
      solution[row] /= root[row][row];
    }
    for (std::size_t row = count; row < terms; ++row) solution[row] = 0;
    return solution;
  }

 private:
  std::array<Terms, terms> squares_{};
  Terms right_{};
};

float gate_at(float gate, const NearPoint& p) noexcept {
  return gate + gate_per_metre * (std::abs(p.x) + std::abs(p.y));
}

}  // namespace

PlaneSearch::PlaneSearch(const MountLimits& limits, bool looks_for_tilt) : limits_(limits) {
  const auto tangent =
      looks_for_tilt ? std::tan(double{limits.max_tilt} * std::numbers::pi / 180) : 0.0;
  const int steps = static_cast<int>(std::ceil(tangent / double{direction_step}));
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) {
      if (i * i + j * j > steps * steps) continue;
      directions_.push_back(unit(
          {direction_step * static_cast<float>(i), direction_step * static_cast<float>(j), 1}));
    }
  }
  few_.resize(few);
  levels_.resize(static_cast<std::size_t>(std::ceil((limits.max_height + 1) / slice)) + 2);
  best_.reserve(most_candidates + 1);
}

PlaneSearch::Candidate PlaneSearch::level_along(std::span<const NearPoint> points,
                                                const Vector3f& up) noexcept {
  // Slices are numbered upwards from below the lowest possible ground. Lower points are in the
  // first slice.
  const auto count = levels_.size();
  const float lowest = -static_cast<float>(count - 1) * slice;
  std::ranges::fill(levels_, 0.0f);
  for (const NearPoint& p : points) {
    const float z = up[0] * p.x + up[1] * p.y + up[2] * p.z;
    if (z >= 0) continue;
    const auto index = static_cast<std::size_t>(std::max((z - lowest) / slice, 0.0f));
    levels_[std::min(index, count - 1)] += p.weight;
  }
  Candidate best;
  float below = 0;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const float height =
        -(lowest + static_cast<float>(i + 1) * slice);  // the middle of i and i + 1
    const float score = levels_[i] + levels_[i + 1] - cost_below * below;
    below += levels_[i - 1];
    if (height + slice < limits_.min_height || height - slice > limits_.max_height) continue;
    if (score > best.score) best = {.plane = {up, height}, .score = score};
  }
  return best;
}

void PlaneSearch::rank_directions(std::span<const NearPoint> points, float lean_cost) noexcept {
  best_.clear();
  std::span<const NearPoint> looked_at = points;
  if (directions_.size() > 1 && points.size() > few) {
    for (std::size_t i = 0; i < few; ++i) few_[i] = points[i * points.size() / few];
    looked_at = few_;
  }
  for (const Vector3f& up : directions_) {
    Candidate candidate = level_along(looked_at, up);
    candidate.score *= belief_in(up, lean_cost);
    if (!(candidate.score > 0)) continue;
    const auto place =
        std::ranges::upper_bound(best_, candidate.score, std::ranges::greater(), &Candidate::score);
    best_.insert(place, candidate);
    if (best_.size() > most_candidates) best_.pop_back();
  }
}

float PlaneSearch::score(std::span<const NearPoint> points,
                         const GroundPlane& plane) const noexcept {
  const Turn turn = turn_to_z(plane.up);
  float in = 0;
  float below = 0;
  for (const NearPoint& p : points) {
    const auto [x, y, z] = turn.apply({p.x, p.y, p.z});
    const float above = plane.above(x, y, z);
    const float gate = gate_at(gates.back(), p);
    const float relative = above / gate;
    const float left = std::max(1 - relative * relative, 0.0f);
    in += p.weight * left * left;
    below += above < -2 * gate ? p.weight : 0;
  }
  return in - cost_below * below;
}

namespace {

GroundPlane refined(std::span<const NearPoint> points, GroundPlane plane) noexcept {
  for (std::size_t round = 0; round < gates.size(); ++round) {
    const Turn turn = turn_to_z(plane.up);
    GroundFit fit;
    for (const NearPoint& p : points) {
      const auto [x, y, z] = turn.apply({p.x, p.y, p.z});
      const float above = plane.above(x, y, z);
      const float gate = gate_at(gates[round], p);
      const float relative = above / (above > 0 && round >= one_sided_from ? gate / 2 : gate);
      const float left = 1 - relative * relative;
      if (left > 0) fit.add(double{p.weight} * left * left, x, y, z + plane.height);
    }
    const auto solution = fit.solve(round < bends_from ? 3 : GroundFit::terms);
    if (!solution) break;
    std::array<float, GroundFit::terms> term{};
    std::ranges::transform(*solution, term.begin(), [](double v) { return static_cast<float>(v); });
    const auto [c, a, b, xx, xy, yy] = term;
    // Convert z = a x + b y + c - height to a normal and a distance along that normal.
    const float shorter = 1 / std::sqrt(1 + a * a + b * b);
    plane = {.up = unit(turn.undo({-a * shorter, -b * shorter, shorter})),
             .height = (plane.height - c) * shorter,
             .xx = xx,
             .xy = xy,
             .yy = yy};
  }
  return plane;
}

}  // namespace

std::optional<GroundPlane> PlaneSearch::find(std::span<const NearPoint> points,
                                             float lean_cost) noexcept {
  rank_directions(points, lean_cost);
  std::optional<GroundPlane> best;
  float best_score = 0;
  for (const Candidate& candidate : best_) {
    const GroundPlane plane = refined(points, candidate.plane);
    const float reached = score(points, plane) * belief_in(plane.up, lean_cost);
    if (best && reached <= best_score) continue;
    best = plane;
    best_score = reached;
  }
  return best;
}

namespace {

enum Kind : std::uint8_t { ground = 1, standing = 2, under = 4 };

/// Maximum distance of ground from the plane, metres, and its increase per metre of range.
constexpr float ground_gate = 0.2f;
constexpr float ground_gate_growth = 0.02f;

/// Points between these heights above the plane belong to obstacles on the ground, metres. Higher
/// points, such as the crowns of trees, are ignored.
constexpr float standing_from = 0.4f;
constexpr float standing_to = 2.0f;

/// Points farther than this below the plane may be in a hole or on ground that slopes down, metres,
/// with its increase per metre of range.
constexpr float below_from = 0.35f;
constexpr float below_growth = 0.08f;

/// Index of one of sixteen directions, found with comparisons only.
std::size_t direction_of(float x, float y) noexcept {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const std::size_t within = std::size_t{ay > 0.41421356f * ax} + std::size_t{ay > ax} +
                             std::size_t{ay > 2.41421356f * ax};
  return (std::size_t{x < 0} * 2 + std::size_t{y < 0}) * 4 + within;
}

/// 0 at or beyond `none`, 1 at or beyond `all`, linear in between.
float share(float value, float none, float all) noexcept {
  return std::clamp((value - none) / (all - none), 0.0f, 1.0f);
}

}  // namespace

AgreementCount::AgreementCount() : cells_(width * width) {}

Agreement AgreementCount::of(std::span<const NearPoint> points, const GroundPlane& plane,
                             float reach) noexcept {
  const float cells_a_metre = static_cast<float>(width) / (2 * reach);
  std::ranges::fill(cells_, std::uint8_t{0});
  const Turn turn = turn_to_z(plane.up);
  const auto index_of = [&](float v) {
    const float place = v * cells_a_metre + centre;
    return std::min(static_cast<std::size_t>(std::max(place, 0.0f)), width - 1);
  };
  double squares = 0;
  double below_weight = 0;
  double sum_x = 0;
  double sum_y = 0;
  double sum_range = 0;
  double weight = 0;
  for (const NearPoint& p : points) {
    const Vector3f place = turn.apply({p.x, p.y, p.z});
    const float z = plane.above(place[0], place[1], place[2]);
    const float range = std::abs(place[0]) + std::abs(place[1]);
    std::uint8_t& cell = cells_[index_of(place[1]) * width + index_of(place[0])];
    if (std::abs(z) < ground_gate + ground_gate_growth * range) {
      cell |= ground;
      if (z < 0) {  // only below: grass increases the distances above
        squares += double{p.weight} * z * z;
        below_weight += double{p.weight};
      }
      sum_x += double{p.weight} * p.x;
      sum_y += double{p.weight} * p.y;
      sum_range += double{p.weight} * std::sqrt(p.x * p.x + p.y * p.y);
      weight += double{p.weight};
    } else if (z > standing_from && z < standing_to) {
      cell |= standing;
    } else if (z < -(below_from + below_growth * range)) {
      cell |= under;
    }
  }

  std::array<int, 16> seen{};   // number of cells with points, per direction
  std::array<int, 16> shows{};  // number of cells with ground, per direction
  float free = 0;
  float below = 0;
  Agreement agreement;
  for (std::size_t row = 0; row < width; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const std::uint8_t cell = cells_[row * width + column];
      if (cell == 0) continue;
      const float x = static_cast<float>(column) + 0.5f - centre;
      const float y = static_cast<float>(row) + 0.5f - centre;
      const std::size_t direction = direction_of(x, y);
      ++seen[direction];
      if ((cell & ground) != 0) {
        ++shows[direction];
        ++agreement.cells;
        if ((cell & standing) == 0) free += 1;
      } else if ((cell & under) != 0) {
        below += 1;
      }
    }
  }
  const auto all = static_cast<float>(agreement.cells);
  agreement.free = all > 0 ? free / all : 0;
  agreement.below = all + below > 0 ? below / (all + below) : 0;
  agreement.spread = below_weight > 0 ? static_cast<float>(std::sqrt(squares / below_weight)) : 0;
  agreement.x = weight > 0 ? static_cast<float>(sum_x / weight) : 0;
  agreement.y = weight > 0 ? static_cast<float>(sum_y / weight) : 0;
  agreement.range = weight > 0 ? static_cast<float>(sum_range / weight) : 0;
  const auto is_told = [](int cells) { return cells > 1; };
  agreement.directions = static_cast<int>(std::ranges::count_if(shows, is_told));
  agreement.seen = static_cast<int>(std::ranges::count_if(seen, is_told));
  return agreement;
}

void judge(MountDecision& decision, float min_confidence) noexcept {
  struct Doubt {
    float belief;
    MountVerdict reason;
  };
  const std::array doubts = {
      Doubt{share(static_cast<float>(decision.cells), 5, 25), MountVerdict::too_few_points},
      Doubt{share(decision.free, 0.2f, 0.5f), MountVerdict::obstructed},
      Doubt{share(decision.below, 0.5f, 0.2f), MountVerdict::points_below},
      Doubt{share(decision.spread, 0.25f, 0.12f), MountVerdict::no_plane},
      Doubt{share(static_cast<float>(decision.directions), 0, 3), MountVerdict::one_sided},
      Doubt{share(static_cast<float>(decision.directions) /
                      static_cast<float>(std::max(decision.seen, 1)),
                  0.3f, 0.6f),
            MountVerdict::one_sided},
  };
  decision.confidence = 1;
  for (const Doubt& doubt : doubts) decision.confidence *= doubt.belief;
  decision.verdict = decision.confidence >= min_confidence
                         ? MountVerdict::accepted
                         : std::ranges::min_element(doubts, {}, &Doubt::belief)->reason;
}

}  // namespace flagstone::mount

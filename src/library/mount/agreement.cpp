// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flagstone::mount {
namespace {

enum Kind : std::uint8_t { ground = 1, standing = 2, under = 4 };

/// Ground lies within this of the plane, metres, and this much more for each metre of range.
constexpr float ground_gate = 0.2f;
constexpr float ground_gate_growth = 0.02f;

/// What lies so far above and no farther stands on the ground, metres: what hangs higher, such as
/// crowns of trees, says nothing about it.
constexpr float standing_from = 0.4f;
constexpr float standing_to = 2.0f;

/// What lies farther below the plane than this may be a hole or falling ground, metres, and this
/// much more for each metre of range.
constexpr float below_from = 0.35f;
constexpr float below_growth = 0.08f;

/// Sixteen directions, by comparisons alone.
std::size_t direction_of(float x, float y) noexcept {
  const float ax = std::abs(x);
  const float ay = std::abs(y);
  const std::size_t within = std::size_t{ay > 0.41421356f * ax} + std::size_t{ay > ax} +
                             std::size_t{ay > 2.41421356f * ax};
  return (std::size_t{x < 0} * 2 + std::size_t{y < 0}) * 4 + within;
}

/// 0 at `none` and beyond, 1 at `all` and beyond, a straight line between.
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
      if (z < 0) {  // above it grass makes it thicker than it is
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

  std::array<int, 16> seen{};   // cells with anything in them, by direction
  std::array<int, 16> shows{};  // those with ground
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

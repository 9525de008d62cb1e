// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/plane.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"

namespace flagstone {
namespace {

/// -1 to 1; the same numbers everywhere.
double any(std::mt19937& random) { return static_cast<double>(random()) / 2147483648.0 - 1; }

using Shape = std::function<Vector3(std::mt19937&)>;

Moments moments_of(const Shape& shape, int points, std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  Moments moments;
  for (int i = 0; i < points; ++i) {
    const Vector3 p = shape(random);
    moments.add(p[0], p[1], p[2]);
  }
  return moments;
}

Vector3 on_rough_ground(std::mt19937& random) {
  const double x = 2 * any(random);
  const double y = 2 * any(random);
  return {x, y, 0.05 * x - 0.02 * y + 0.02 * any(random)};
}
Vector3 on_a_wall(std::mt19937& random) { return {3 * any(random), 0.5, 2 * any(random)}; }
Vector3 on_a_level_line(std::mt19937& random) { return {3 * any(random), 0.5, 0.1}; }
Vector3 on_a_slanted_line(std::mt19937& random) {
  const double t = any(random);
  return {2 * t, t, 0.5 * t};
}
Vector3 on_a_pole(std::mt19937& random) { return {0.25, -0.5, 2 * any(random)}; }
Vector3 in_a_ball(std::mt19937& random) {
  for (;;) {
    const Vector3 p = {any(random), any(random), any(random)};
    if (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < 1) return p;
  }
}
Vector3 in_one_place(std::mt19937& /*random*/) { return {0.3, -0.7, 0.1}; }
Vector3 on_ground_far_away(std::mt19937& random) {
  const Vector3 p = on_rough_ground(random);
  return {p[0] + 40, p[1] - 40, p[2]};
}

const std::vector<Shape> shapes = {on_rough_ground, on_a_wall, on_a_level_line, on_a_slanted_line,
                                   on_a_pole,       in_a_ball, in_one_place,    on_ground_far_away};

/// Stores one set at index `i` of the sixteen.
void place(const Moments& moments, std::size_t i, MomentsBatch& batch) {
  batch.count[i] = moments.count;
  for (std::size_t k = 0; k < 3; ++k) batch.sum[k][i] = moments.sum[k];
  for (std::size_t k = 0; k < 6; ++k) batch.squares[k][i] = moments.squares[k];
}

/// The bits of all numbers of a plane.
std::vector<std::uint64_t> bits_of(const Plane& p) {
  std::vector<std::uint64_t> bits;
  for (const double number :
       {p.count, p.mean[0], p.mean[1], p.mean[2], p.normal[0], p.normal[1], p.normal[2], p.d,
        p.eigenvalues[0], p.eigenvalues[1], p.eigenvalues[2]}) {
    bits.push_back(std::bit_cast<std::uint64_t>(number));
  }
  return bits;
}

/// A set of any shape, size and seed.
Moments any_moments() {
  const auto shape = *rc::gen::inRange<std::size_t>(0, shapes.size());
  return moments_of(shapes[shape], *rc::gen::inRange(3, 300), *rc::gen::arbitrary<std::uint32_t>());
}

/// True if plane 0 is ill-conditioned. The other fifteen are rough ground.
bool is_doubtful(const Moments& moments) {
  MomentsBatch batch{};
  for (std::size_t i = 0; i < batch_size; ++i) place(moments_of(on_rough_ground, 50), i, batch);
  place(moments, 0, batch);
  PlaneBatch planes;
  const std::uint32_t doubtful = fit_planes(batch, planes);
  EXPECT_EQ(doubtful & ~1U, 0U) << "ground is well-conditioned";
  return doubtful != 0;
}

TEST(FitPlanes, FitsSixteenPlanesLikeSinglePlanes) {
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    EXPECT_TRUE(rc::check("on " + target, [] {
      std::vector<Moments> moments;
      MomentsBatch batch{};
      for (std::size_t i = 0; i < batch_size; ++i) {
        moments.push_back(any_moments());
        place(moments[i], i, batch);
      }

      PlaneBatch planes;
      fit_planes(batch, planes);

      for (std::size_t i = 0; i < batch_size; ++i) {
        RC_ASSERT(bits_of(planes[i]) == bits_of(plane_of(moments[i])));
      }
    }));
  }
}

TEST(FitPlanes, IsBitIdenticalOnEveryInstructionSet) {
  EXPECT_TRUE(rc::check([] {
    MomentsBatch batch{};
    for (std::size_t i = 0; i < batch_size; ++i) place(any_moments(), i, batch);
    PlaneBatch expected;
    const std::uint32_t expected_doubts = fit_planes(batch, expected);

    for (const std::string& target : simd_targets()) {
      const tests::ForcedTarget forced(target);
      PlaneBatch planes;
      RC_ASSERT(fit_planes(batch, planes) == expected_doubts);
      for (std::size_t i = 0; i < batch_size; ++i) {
        RC_ASSERT(bits_of(planes[i]) == bits_of(expected[i]));
      }
    }
  }));
}

TEST(FitPlanes, FindsThePlaneOfItsPoints) {
  const Vector3 n = {0.6, 0, 0.8};
  const auto on_plane = [&](std::mt19937& random) -> Vector3 {
    const double u = any(random);
    const double v = 3 * any(random);
    return {2 * n[0] + u * n[2], v, 2 * n[2] - u * n[0]};
  };
  MomentsBatch batch{};
  place(moments_of(on_plane, 100), 5, batch);

  PlaneBatch planes;
  fit_planes(batch, planes);

  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(planes[5].normal[k], n[k], 1e-12);
  EXPECT_NEAR(planes[5].d, -2, 1e-12);
}

TEST(FitPlanes, KeepsTheNumberOfPointsAndNeedsThree) {
  MomentsBatch batch{};
  for (int i = 0; i < 16; ++i) {
    place(moments_of(on_rough_ground, i), static_cast<std::size_t>(i), batch);
  }

  PlaneBatch planes;
  const std::uint32_t doubtful = fit_planes(batch, planes);

  for (std::size_t i = 0; i < batch_size; ++i) EXPECT_EQ(planes[i].exists(), i >= 3) << i;
  EXPECT_EQ(doubtful & 7U, 0U) << "planes that do not exist are not reported";
}

TEST(FitPlanes, ReportsGroundAsWellConditioned) {
  EXPECT_FALSE(is_doubtful(moments_of(on_rough_ground, 50)));
}

TEST(FitPlanes, ReportsPointsOnALineAsIllConditioned) {
  EXPECT_TRUE(is_doubtful(moments_of(on_a_level_line, 50)));
  EXPECT_TRUE(is_doubtful(moments_of(on_a_slanted_line, 50)));
  EXPECT_TRUE(is_doubtful(moments_of(on_a_pole, 50)));
}

TEST(FitPlanes, ReportsPointsInABallAsIllConditioned) {
  EXPECT_TRUE(is_doubtful(moments_of(in_a_ball, 20000)));
}

TEST(FitPlanes, ReportsPointsAtOnePositionAsIllConditioned) {
  EXPECT_TRUE(is_doubtful(moments_of(in_one_place, 50)));
}

TEST(FitPlanes, ReportsGroundFarFromTheOriginAsIllConditioned) {
  EXPECT_TRUE(is_doubtful(moments_of(on_ground_far_away, 50)));
}

}  // namespace
}  // namespace flagstone

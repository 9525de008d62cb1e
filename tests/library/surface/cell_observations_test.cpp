// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/cell_observations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/owned_grid.hpp"
#include "library/surface/vector_functions.hpp"

namespace flagstone::surface {
namespace {

using tests::OwnedGrid;

constexpr float gate = 0.4f;
constexpr float gate_per_metre = 0.004f;
constexpr float max_clutter_ratio = 0.5f;
constexpr float lower_bound_weight = 0.1f;
constexpr float wide_gate = 0.8f;

/// Half a unit of a packed z, metres.
constexpr double half_unit = 0.5 / z_per_metre;

/// A height in units of a packed z.
int units(float metres) { return static_cast<int>(std::lround(metres * z_per_metre)); }

/// The observation of a cell.
struct Observation {
  double weight = 0;  ///< 0 without an observation
  double correction = 0;
};

/// A naive implementation of the observation, from the header and the constants of the code.
/// `heights`: heights above the surface of up to 32 points; `reach`: the gate; both in units of a
/// packed z. Constants in metres are rounded down to units.
Observation naive(const std::vector<int>& heights, int reach) {
  const auto whole = [](double metres) { return static_cast<int>(metres * z_per_metre); };
  std::vector<int> gated;
  std::vector<int> seen;
  for (const int h : heights) {
    if (std::abs(h) <= reach) gated.push_back(h);
    if (h <= -(reach + whole(1.5)) || h >= reach + whole(1)) continue;
    seen.push_back(h);
  }
  std::ranges::sort(seen);
  std::size_t alone = 0;  // up to two points far below the next
  while (alone < 2 && alone + 1 < seen.size() && seen[alone + 1] - seen[alone] > whole(0.2)) {
    ++alone;
  }
  const int lowest = seen.empty() ? std::numeric_limits<int>::max() : seen[alone];
  const auto lower_bound = [&]() -> Observation {
    if (seen.size() < 8 || lowest >= -whole(0.03)) return {};
    return {.weight = static_cast<double>(lower_bound_weight),
            .correction = static_cast<double>(lowest) / z_per_metre};
  };
  if (gated.size() < 3) return lowest < -reach ? lower_bound() : Observation{};

  std::ranges::sort(gated);
  int middle = gated.size() < 5 ? gated[0] : gated[gated.size() < 10 ? 1 : 2];
  const auto in_window = [&](int h) { return std::abs(h - middle) <= whole(0.12); };
  double mean = 0;
  for (int step = 0; step < 2; ++step) {
    double sum = 0;
    double count = 0;
    for (const int h : gated) {
      if (!in_window(h)) continue;
      sum += h;
      ++count;
    }
    mean = count > 0 ? sum / count : middle;
    middle = static_cast<int>(std::nearbyint(mean));
  }
  const auto at_surface = static_cast<double>(std::ranges::count_if(gated, in_window));
  const auto above = static_cast<double>(std::ranges::count_if(
      seen, [&](int h) { return h > middle + whole(0.18) && h < middle + whole(0.88); }));
  const auto below = static_cast<double>(
      std::ranges::count_if(gated, [&](int h) { return h < middle - whole(0.144); }));
  if (at_surface < 3) return {};
  if (above > static_cast<double>(max_clutter_ratio) * at_surface) return lower_bound();
  if (below > 0.05 * at_surface) return {};
  return {.weight = std::min(1.0, at_surface / 10), .correction = mean / z_per_metre};
}

/// Points in the cells of a grid of 8 x 8 cells of 1 m, and their observations. The parameter is
/// the instruction set.
class CellObservations : public testing::TestWithParam<std::string> {
 protected:
  CellObservations() { grid_.set(ground); }

  /// Adds a cell with points at random positions and these heights above the surface, in units of a
  /// packed z.
  void add_cell(std::uint32_t row, std::uint32_t column, const std::vector<int>& heights) {
    cells_.push_back({.first = static_cast<std::uint32_t>(points_.size()),
                      .count = static_cast<std::uint32_t>(heights.size()),
                      .place = 8 * row + column});
    for (const int height : heights) {
      // The position in units of packed points from the edge of the grid.
      const std::uint32_t x = xy_per_metre * column + random_() % xy_per_metre;
      const std::uint32_t y = xy_per_metre * row + random_() % xy_per_metre;
      const int z = ground_units(x, y) + height;
      points_.push_back((x & 0xFFU) | (y & 0xFFU) << 8U | static_cast<std::uint32_t>(z) << 16U);
    }
  }

  /// Adds a cell with points at random positions and these heights above the surface, metres.
  void add_cell(std::uint32_t row, std::uint32_t column, const std::vector<float>& heights) {
    std::vector<int> whole(heights.size());
    std::ranges::transform(heights, whole.begin(), units);
    add_cell(row, column, whole);
  }

  /// Adds a cell with points on a plane through its centre on the surface. `slopes` in m/m.
  void add_plane(std::uint32_t row, std::uint32_t column, std::array<float, 2> slopes,
                 std::size_t count) {
    add_cell(row, column, std::vector<int>(count, 0));
    for (std::size_t i = points_.size() - count; i < points_.size(); ++i) {
      const auto from_centre = [&](unsigned shift) {
        return static_cast<float>(points_[i] >> shift & 127U) / 128 - 0.5f;
      };
      const float height = slopes[0] * from_centre(0) + slopes[1] * from_centre(8);
      points_[i] += static_cast<std::uint32_t>(units(height)) << 16U;
    }
  }

  /// Observes the cells, each with its size.
  void observe_all() {
    unclear_.clear();
    for (const CellSize size : {CellSize::small, CellSize::medium, CellSize::large}) {
      std::vector<OccupiedCell> of_size = cells_;
      std::erase_if(of_size, [&](const OccupiedCell& cell) { return size_of(cell) != size; });
      observe_as(size, of_size);
    }
  }

  /// Observes cells as cells of this size.
  void observe_as(CellSize size, const std::vector<OccupiedCell>& cells) {
    with_observations([&](const Observations& observations) {
      std::vector<OccupiedCell> unclear(cells.size());
      std::vector<std::uint32_t> firsts;
      std::vector<std::uint32_t> counts;
      std::vector<std::uint32_t> places;
      for (const OccupiedCell& cell : cells) {
        firsts.push_back(cell.first);
        counts.push_back(cell.count);
        places.push_back(cell.place);
      }
      const OccupiedCells columns{.firsts = firsts.data(),
                                  .counts = counts.data(),
                                  .places = places.data(),
                                  .size = cells.size()};
      unclear.resize(observe(observations, columns, size, unclear.data()));
      unclear_.insert(unclear_.end(), unclear.begin(), unclear.end());
    });
  }

  /// Observes all cells, then the unclear ones a second time. Returns the candidates.
  std::vector<Candidate> looked_again(SecondLook look) {
    second_look_ = look;
    observe_all();
    std::vector<Candidate> candidates(unclear_.size());
    with_observations([&](const Observations& observations) {
      observe_again(observations, unclear_, candidates.data());
    });
    return candidates;
  }

  /// Calls `work` with the points and the grid.
  template <class Work>
  void with_observations(const Work& work) {
    std::vector<std::int32_t> slopes(64 + 16);
    std::vector<std::int32_t> offsets(64 + 16);
    const CellPlanes planes{.slopes = slopes.data(), .offsets = offsets.data()};
    std::vector<float> memory;
    find_planes(grid_.readable(memory), expected_ground, planes);
    std::vector<std::int16_t> gates;
    for (std::size_t place = 0; place < 64; ++place) {
      gates.push_back(static_cast<std::int16_t>(reach(place)));
    }
    std::vector<PackedPoint> readable = points_;
    readable.resize(points_.size() + 16);
    work(Observations{.points = readable.data(),
                      .planes = planes,
                      .gates = gates.data(),
                      .second_look = second_look_,
                      .half_bit = 6,
                      .widening = static_cast<std::int16_t>(units(wide_gate - gate)),
                      .max_clutter_ratio = max_clutter_ratio,
                      .lower_bound_weight = lower_bound_weight,
                      .corrections = corrections_.data(),
                      .weights = weights_.data()});
  }

  static CellSize size_of(const OccupiedCell& cell) {
    if (cell.count <= small_cell) return CellSize::small;
    return cell.count <= medium_cell ? CellSize::medium : CellSize::large;
  }

  /// The observation of a single cell near the sensor.
  template <class Height>
  Observation observed(const std::vector<Height>& heights) {
    add_cell(4, 4, heights);
    observe_all();
    return observation(4 * 8 + 4);
  }

  [[nodiscard]] Observation observation(std::size_t place) const {
    if (weights_[place] <= 0) return {};
    return {.weight = weights_[place], .correction = corrections_[place]};
  }

  void clear() {
    points_.clear();
    cells_.clear();
    std::ranges::fill(corrections_, 0.0f);
    std::ranges::fill(weights_, 0.0f);
  }

  /// Height of a packed z of 0, metres.
  static constexpr float expected_ground = -1.5f;

  /// Tilted, so that heights differ from z.
  static float ground(float x, float y) { return -1.75f + 0.25f * x - 0.125f * y; }

  /// The height of the ground above the expected ground at the centre of a unit of packed points,
  /// in units of a packed z.
  static int ground_units(std::uint32_t x, std::uint32_t y) {
    const auto metres = [](std::uint32_t u) { return (static_cast<float>(u) + 0.5f) / 128 - 4; };
    const float height = ground(metres(x), metres(y)) - expected_ground;
    return static_cast<int>(std::floor(height * z_per_metre + 0.5f));
  }

  /// The gate of a cell, in units of a packed z.
  [[nodiscard]] int reach(std::size_t place) const {
    const Grid& grid = grid_.grid();
    return units(gate +
                 gate_per_metre * std::hypot(grid.center(place % 8), grid.center(place / 8)));
  }

  std::mt19937 random_{1};
  OwnedGrid grid_{1, 8};
  std::vector<PackedPoint> points_;
  std::vector<OccupiedCell> cells_;
  SecondLook second_look_ = SecondLook::wide;
  std::vector<OccupiedCell> unclear_;
  std::vector<float> corrections_ = std::vector<float>(64, 0.0f);
  std::vector<float> weights_ = std::vector<float>(64, 0.0f);

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, CellObservations, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

/// `count` heights that increase by `step` from `lowest`.
std::vector<float> rising(float lowest, float step, std::size_t count) {
  std::vector<float> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = lowest + step * static_cast<float>(i);
  return heights;
}

TEST_P(CellObservations, FlatGroundGivesItsHeightAboveTheSurface) {
  const Observation ground = observed(std::vector<float>(20, 0.1f));

  EXPECT_EQ(ground.weight, 1);
  EXPECT_NEAR(ground.correction, 0.1, half_unit);
}

TEST_P(CellObservations, FewerPointsHaveLessWeight) {
  EXPECT_NEAR(observed(std::vector<float>(4, -0.1f)).weight, 0.4, 1e-6);
}

TEST_P(CellObservations, TwoPointsGiveNoObservation) {
  EXPECT_EQ(observed<float>({0.1f, 0.1f, 2.5f}).weight, 0);
}

TEST_P(CellObservations, AKerbGivesTheHeightOfItsLowerSide) {
  // Ten points in a gutter, and eight on the pavement 14 cm above, which is too low to be an
  // obstacle.
  std::vector<float> kerb(10, 0.0f);
  kerb.insert(kerb.end(), 8, 0.14f);

  const Observation side = observed(kerb);

  EXPECT_EQ(side.weight, 1);
  EXPECT_NEAR(side.correction, 0, 0.03);
}

TEST_P(CellObservations, AWallGivesOnlyALowerBoundAtItsBase) {
  const std::vector<float> wall = rising(-0.2f, 0.05f, 24);

  const Observation bound = observed(wall);

  EXPECT_NEAR(bound.weight, lower_bound_weight, 1e-6);
  EXPECT_NEAR(bound.correction, -0.2, half_unit);
}

TEST_P(CellObservations, AWallWithItsBaseAtTheSurfaceGivesNoObservation) {
  const std::vector<float> wall = rising(-0.02f, 0.05f, 24);

  EXPECT_EQ(observed(wall).weight, 0);
}

TEST_P(CellObservations, AGhostPointFarBelowChangesNothing) {
  std::vector<float> heights(20, 0.05f);
  heights.push_back(-1.0f);

  const Observation ground = observed(heights);

  EXPECT_EQ(ground.weight, 1);
  EXPECT_NEAR(ground.correction, 0.05, half_unit);
}

TEST_P(CellObservations, SeveralPointsBelowTheModeGiveNoObservation) {
  // The two low points are too few for a mode of their height, and too many below the mode above
  // them.
  std::vector<float> heights = {-0.3f, -0.3f};
  heights.insert(heights.end(), 20, 0.1f);

  EXPECT_EQ(observed(heights).weight, 0);
}

TEST_P(CellObservations, PointsExactlyAtTheLimitAreNotBelowTheMode) {
  const auto weight_of = [&](int low) {
    clear();
    std::vector<int> heights(20, 0);
    heights.insert(heights.end(), 2, low);
    return observed(heights).weight;
  };

  EXPECT_EQ(weight_of(-73), 1);  // 0.144 m are 73.7 units
  EXPECT_EQ(weight_of(-74), 0);
}

TEST_P(CellObservations, PointsExactlyAtTheLimitAreNotAnObstacle) {
  const auto weight_of = [&](int high) {
    clear();
    std::vector<int> heights(20, 0);
    heights.insert(heights.end(), 11, high);
    return observed(heights).weight;
  };

  EXPECT_EQ(weight_of(92), 1);  // 0.18 m are 92.2 units
  EXPECT_EQ(weight_of(93), 0);
  EXPECT_EQ(weight_of(449), 0);
  EXPECT_EQ(weight_of(450), 1);  // 0.88 m are 450.6 units
}

TEST_P(CellObservations, ABushAboveTheSurfaceGivesNoObservation) {
  const std::vector<float> bush = rising(0.1f, 0.04f, 20);

  EXPECT_EQ(observed(bush).weight, 0);
}

TEST_P(CellObservations, PointsTooFarAboveAreIgnored) {
  std::vector<float> heights(12, 0.0f);
  heights.insert(heights.end(), 18, 1.6f);  // a car door or foliage

  EXPECT_EQ(observed(heights).weight, 1);
}

TEST_P(CellObservations, WriteOnlyListedCells) {
  std::ranges::fill(corrections_, 7.0f);
  std::ranges::fill(weights_, 7.0f);
  add_cell(2, 3, std::vector<float>(12, 0.1f));
  add_cell(2, 4, std::vector<float>{0.1f});

  observe_all();

  EXPECT_EQ(observation(2 * 8 + 3).weight, 1);
  EXPECT_EQ(observation(2 * 8 + 4).weight, 0);
  EXPECT_EQ(observation(3 * 8 + 3).weight, 7);
  EXPECT_EQ(observation(3 * 8 + 3).correction, 7);
}

TEST_P(CellObservations, LargeCellsUseASampleOfTheirPoints) {
  std::vector<int> heights(200);
  for (int& height : heights) height = static_cast<int>(random_() % 60);
  add_cell(4, 4, heights);
  observe_all();
  const Observation of_all = observation(4 * 8 + 4);

  const std::vector<PackedPoint> sample = tests::sample_of(points_, {.most = 32, .wanted = 26});
  points_ = sample;
  cells_[0].count = static_cast<std::uint32_t>(sample.size());
  observe_all();

  EXPECT_EQ(of_all.weight, 1);
  EXPECT_EQ(of_all.weight, observation(4 * 8 + 4).weight);
  EXPECT_EQ(of_all.correction, observation(4 * 8 + 4).correction);
}

TEST_P(CellObservations, DoNotDependOnTheOrderOfThePoints) {
  for (const std::size_t count : {4U, 16U, 17U, 32U, 33U, 100U, 1000U}) {
    clear();
    std::vector<int> heights(count);
    for (int& height : heights) height = static_cast<int>(random_() % 150) - 40;
    const Observation expected = observed(heights);
    for (int repeat = 0; repeat < 10; ++repeat) {
      std::ranges::shuffle(points_, random_);
      std::ranges::fill(weights_, 0.0f);
      std::ranges::fill(corrections_, 0.0f);

      observe_all();

      EXPECT_EQ(observation(4 * 8 + 4).weight, expected.weight) << count;
      EXPECT_EQ(observation(4 * 8 + 4).correction, expected.correction) << count;
    }
  }
}

TEST_P(CellObservations, DoNotDependOnOtherCells) {
  // 33 cells: one more than are observed together.
  std::vector<Observation> alone;
  for (std::uint32_t i = 0; i < 33; ++i) {
    std::vector<int> heights(12);
    for (int& height : heights) height = static_cast<int>(random_() % 100);
    add_cell(i / 8, i % 8, heights);
  }
  for (const OccupiedCell& cell : cells_) {
    observe_as(CellSize::small, {cell});
    alone.push_back(observation(cell.place));
  }
  std::ranges::fill(corrections_, 0.0f);
  std::ranges::fill(weights_, 0.0f);

  observe_all();

  for (std::size_t i = 0; i < cells_.size(); ++i) {
    EXPECT_EQ(observation(cells_[i].place).weight, alone[i].weight) << i;
    EXPECT_EQ(observation(cells_[i].place).correction, alone[i].correction) << i;
  }
}

TEST_P(CellObservations, TwoReflectionsBelowAWallAreNotItsBase) {
  std::vector<float> wall = rising(-0.1f, 0.05f, 24);
  wall.insert(wall.end(), {-1.2f, -0.7f});

  EXPECT_NEAR(observed(wall).correction, -0.1, half_unit);
}

TEST_P(CellObservations, ABankIsAnObstacleAtFirstButNotAlongItsSlope) {
  add_plane(4, 4, {0.8f, -0.3f}, 24);

  const std::vector<Candidate> found = looked_again(SecondLook::tilted);

  EXPECT_NE(observation(4 * 8 + 4).weight, 1);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].place, 4 * 8 + 4);
  EXPECT_EQ(found[0].weight, 1);
  EXPECT_NEAR(found[0].correction, 0, 0.06);
}

TEST_P(CellObservations, AWallIsAnObstacleAlongAnySlope) {
  add_cell(4, 4, rising(-0.2f, 0.05f, 24));

  const std::vector<Candidate> found = looked_again(SecondLook::tilted);

  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].weight, 0);
}

TEST_P(CellObservations, AFewPointsAboveGroundAreAnObstacleForTheSecondLookOnly) {
  std::vector<float> tuft(20, 0.0f);
  tuft.insert(tuft.end(), 9, 0.4f);
  EXPECT_EQ(observed(tuft).weight, 1);
  clear();

  // The same, 60 cm higher: above the gate.
  for (float& height : tuft) height += 0.6f;
  add_cell(4, 4, tuft);
  const std::vector<Candidate> found = looked_again(SecondLook::wide);

  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].weight, 0);
}

TEST_P(CellObservations, GroundAboveTheGateIsFoundInAWiderGate) {
  add_cell(4, 4, std::vector<float>(12, 0.6f));

  const std::vector<Candidate> found = looked_again(SecondLook::wide);

  EXPECT_EQ(observation(4 * 8 + 4).weight, 0);
  ASSERT_EQ(found.size(), 1);
  EXPECT_EQ(found[0].weight, 1);
  EXPECT_NEAR(found[0].correction, 0.6, half_unit);
}

TEST_P(CellObservations, GroundWithMostPointsAboveItIsNotFoundInAWiderGate) {
  std::vector<float> below_a_roof(8, 0.6f);
  below_a_roof.insert(below_a_roof.end(), 9, 1.75f);
  add_cell(4, 4, below_a_roof);
  below_a_roof.pop_back();
  add_cell(4, 5, below_a_roof);

  const std::vector<Candidate> found = looked_again(SecondLook::wide);

  ASSERT_EQ(found.size(), 2);
  EXPECT_EQ(std::ranges::count(found, 0.0f, &Candidate::weight), 1);
}

TEST_P(CellObservations, OnlyCellsThatASecondLookCanHelpAreUnclear) {
  add_cell(1, 1, std::vector<float>(20, 0.1f));   // ground
  add_cell(1, 2, rising(-0.2f, 0.05f, 24));       // an obstacle
  add_cell(1, 3, std::vector<float>(20, 0.6f));   // above the gate
  add_cell(1, 4, std::vector<float>(40, 1.2f));   // above the wider gate
  add_cell(1, 5, std::vector<float>(20, -0.8f));  // below the gate
  const auto unclear_columns = [&](SecondLook look) {
    std::vector<std::uint32_t> columns;
    for (const Candidate& candidate : looked_again(look)) columns.push_back(candidate.place % 8);
    return columns;
  };

  EXPECT_THAT(unclear_columns(SecondLook::tilted), testing::ElementsAre(2));
  EXPECT_THAT(unclear_columns(SecondLook::wide), testing::ElementsAre(3));
}

TEST_P(CellObservations, SecondLooksAreTheSameForAnyOrderAndEveryInstructionSet) {
  for (const SecondLook look : {SecondLook::tilted, SecondLook::wide}) {
    clear();
    std::uniform_real_distribution<float> slope(-4.5f, 4.5f);
    for (std::uint32_t i = 0; i < 64; ++i) {
      const std::size_t count = 3 + random_() % (i % 2 == 0 ? 16 : 80);
      if (i % 3 == 0) {
        add_plane(i / 8, i % 8, {slope(random_), slope(random_)}, count);
      } else {
        std::vector<int> heights(count);
        for (int& height : heights) height = static_cast<int>(random_() % (i * 50U + 1U)) - 100;
        add_cell(i / 8, i % 8, heights);
      }
    }
    const std::vector<Candidate> expected = looked_again(look);
    EXPECT_GT(expected.size(), 3);
    const auto expect_the_same = [&] {
      const std::vector<Candidate> found = looked_again(look);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].place, expected[i].place);
        EXPECT_EQ(found[i].weight, expected[i].weight);
        EXPECT_EQ(found[i].correction, expected[i].correction);
      }
    };
    for (const OccupiedCell& cell : cells_) {
      const auto first = points_.begin() + cell.first;
      std::shuffle(first, first + cell.count, random_);
    }
    expect_the_same();
    const tests::ForcedTarget plain(simd_targets().front());
    expect_the_same();
  }
}

TEST_P(CellObservations, SmallCellsGiveTheSameResultAsMediumCells) {
  add_cell(1, 1, rising(-0.2f, 0.06f, small_cell));
  add_cell(2, 5, std::vector<float>(small_cell, 0.15f));
  observe_as(CellSize::medium, cells_);
  const std::vector<float> corrections(corrections_.begin(), corrections_.end());
  const std::vector<float> weights(weights_.begin(), weights_.end());

  observe_as(CellSize::small, cells_);

  EXPECT_THAT(corrections, testing::ElementsAreArray(corrections_));
  EXPECT_THAT(weights, testing::ElementsAreArray(weights_));
}

TEST_P(CellObservations, MatchANaiveImplementation) {
  std::uniform_real_distribution<float> share(0, 1);
  for (int repeat = 0; repeat < 40; ++repeat) {
    clear();
    std::vector<std::vector<int>> all;
    for (std::uint32_t row = 0; row < 8; ++row) {
      for (std::uint32_t column = 0; column < 8; ++column) {
        if (share(random_) < 0.2f) continue;
        // Rough ground, and fractions of points above and below it.
        const float middle = 0.8f * share(random_) - 0.4f;
        const float roughness = 0.2f * share(random_);
        const float standing = share(random_) * share(random_);
        const float below = 0.3f * share(random_) * share(random_);
        std::vector<int> heights(3 + random_() % 30);
        for (int& height : heights) {
          float metres = middle + roughness * (share(random_) - 0.5f);
          if (share(random_) < standing) metres += 1.5f * share(random_);
          if (share(random_) < below) metres -= 2 * share(random_);
          height = units(metres);
        }
        add_cell(row, column, heights);
        all.push_back(heights);
      }
    }

    observe_all();

    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const Observation expected = naive(all[i], reach(cells_[i].place));
      const Observation found = observation(cells_[i].place);
      ASSERT_NEAR(found.weight, expected.weight, 1e-6) << "cell " << i << ", repeat " << repeat;
      ASSERT_NEAR(found.correction, expected.correction, 1e-6);
    }
  }
}

}  // namespace
}  // namespace flagstone::surface

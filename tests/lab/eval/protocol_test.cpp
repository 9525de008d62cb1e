// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace flagstone::eval {
namespace {

using testing::ElementsAre;
using enum Truth;

constexpr std::array<float, 12> four_points = {5, 0, -1.7f, 5, 0, -1.31f, 5, 0, -1.3f, 5, 0, 2};
const CloudView cloud(four_points.data(), 4);

TEST(Protocol, ThePapersCountsLowVegetationAsGroundAndEveryPoint) {
  constexpr std::array<std::uint32_t, 4> classes = {0, 70, 70, 70};

  EXPECT_THAT(truth_of(patchwork_protocol(), cloud, classes),
              ElementsAre(not_ground, ground, not_ground, not_ground));
}

TEST(Protocol, PatchworkPlusPlusDoesNotScoreUnlabelledOutliersAndVegetation) {
  constexpr std::array<std::uint32_t, 4> classes = {0, 1, 70, 50};

  EXPECT_THAT(truth_of(patchwork_plusplus_protocol(), cloud, classes),
              ElementsAre(ignored, ignored, ignored, not_ground));
}

TEST(Protocol, TheSixGroundClassesAreGroundUnderAllThatUseSemanticKittiIds) {
  for (const Protocol* protocol :
       {&patchwork_protocol(), &patchwork_plusplus_protocol(), &simulation_protocol()}) {
    for (const std::uint32_t id : {40u, 44u, 48u, 49u, 60u, 72u}) {
      const std::array<std::uint32_t, 4> classes = {id, id, id, id};
      EXPECT_THAT(truth_of(*protocol, cloud, classes), ElementsAre(ground, ground, ground, ground))
          << protocol->name << ", class " << id;
    }
  }
}

TEST(Protocol, SimulationScoresGhostsAndVegetationAsNotGround) {
  constexpr std::array<std::uint32_t, 4> classes = {1, 70, 70, 40};

  EXPECT_THAT(truth_of(simulation_protocol(), cloud, classes),
              ElementsAre(not_ground, not_ground, not_ground, ground));
}

TEST(Protocol, LidarsegScoresFlatSurfacesAndLeavesOutTheOwnVehicle) {
  constexpr std::array<std::uint32_t, 4> classes = {24, 27, 31, 17};

  EXPECT_THAT(truth_of(lidarseg_protocol(), cloud, classes),
              ElementsAre(ground, ground, ignored, not_ground));
}

}  // namespace
}  // namespace flagstone::eval

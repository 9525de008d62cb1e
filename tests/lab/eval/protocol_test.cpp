// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/protocol.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

#include "files/io/temporary_folder.hpp"

namespace flagstone::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::array<float, 12> four_points = {5, 0, -1.7f, 5, 0, -1.31f, 5, 0, -1.3f, 5, 0, 2};
const CloudView cloud(four_points.data(), 4);

TEST(Protocol, PatchworkCountsLowVegetationAsGroundAndScoresEveryPoint) {
  using enum Truth;
  constexpr std::array<std::uint32_t, 4> classes = {0, 70, 70, 70};

  EXPECT_THAT(truth_of(patchwork_protocol(), cloud, classes),
              ElementsAre(not_ground, ground, not_ground, not_ground));
}

TEST(Protocol, PatchworkPlusPlusDoesNotScoreUnlabelledOutliersAndVegetation) {
  using enum Truth;
  constexpr std::array<std::uint32_t, 4> classes = {0, 1, 70, 50};

  EXPECT_THAT(truth_of(patchwork_plusplus_protocol(), cloud, classes),
              ElementsAre(ignored, ignored, ignored, not_ground));
}

TEST(Protocol, TheSixGroundClassesAreGroundInAllSemanticKittiProtocols) {
  using enum Truth;
  for (const Protocol* protocol :
       {&patchwork_protocol(), &patchwork_plusplus_protocol(), &simulation_protocol()}) {
    for (const std::uint32_t id : {40u, 44u, 48u, 49u, 60u, 72u}) {
      const std::array<std::uint32_t, 4> classes = {id, id, id, id};
      EXPECT_THAT(truth_of(*protocol, cloud, classes), ElementsAre(ground, ground, ground, ground))
          << protocol->name << ", class " << id;
    }
  }
}

TEST(Protocol, SimulationScoresGhostPointsAndVegetationAsNotGround) {
  using enum Truth;
  constexpr std::array<std::uint32_t, 4> classes = {1, 70, 70, 40};

  EXPECT_THAT(truth_of(simulation_protocol(), cloud, classes),
              ElementsAre(not_ground, not_ground, not_ground, ground));
}

TEST(Protocol, LidarsegScoresFlatSurfacesAndIgnoresTheEgoVehicle) {
  using enum Truth;
  constexpr std::array<std::uint32_t, 4> classes = {24, 27, 31, 17};

  EXPECT_THAT(truth_of(lidarseg_protocol(), cloud, classes),
              ElementsAre(ground, ground, ignored, not_ground));
}

class ProtocolFile : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& text) {
    const auto path = folder_ / name;
    std::ofstream(path) << text;
    return path;
  }

  std::string error_of(const std::string& name, const std::string& text) {
    Protocol protocol;
    const Status status = read_protocol(put(name, text), protocol);
    EXPECT_FALSE(status.ok()) << text;
    EXPECT_THAT(status.message(), AllOf(HasSubstr(name), Not(HasSubstr("\n"))));
    return status.message();
  }

  io::TemporaryFolder folder_;
};

TEST_F(ProtocolFile, JsonAndTomlGiveTheSameProtocol) {
  Protocol json;
  Protocol toml;
  ASSERT_TRUE(read_protocol(put("mine.json", R"({"ground": [40, 48], "ignored": [0],
      "not_ground": [10, 70], "low_ground": [{"id": 70, "height": -1.5}], "note": "text"})"),
                            json)
                  .ok());
  ASSERT_TRUE(read_protocol(put("mine.toml",
                                "ground = [40, 48]\nignored = [0]\nnot_ground = [10]\n"
                                "low_ground = [{id = 70, height = -1.5}]\n"),
                            toml)
                  .ok());

  for (const Protocol& protocol : {json, toml}) {
    EXPECT_EQ(protocol.name, "mine");
    EXPECT_THAT(protocol.ground, ElementsAre(40, 48));
    EXPECT_THAT(protocol.ignored, ElementsAre(0));
    ASSERT_EQ(protocol.low_ground.size(), 1u);
    EXPECT_EQ(protocol.low_ground[0].id, 70u);
    EXPECT_EQ(protocol.low_ground[0].height, -1.5f);
  }
}

TEST_F(ProtocolFile, UsesTheNameInTheFile) {
  Protocol protocol;
  ASSERT_TRUE(read_protocol(put("a.toml", "name = \"terrain\"\nground = [2]\n"), protocol).ok());

  EXPECT_EQ(protocol.name, "terrain");
  EXPECT_THAT(protocol.ignored, IsEmpty());
}

TEST_F(ProtocolFile, ReportsErrorsOnOneLineWithTheKey) {
  EXPECT_THAT(error_of("a.json", "{"), HasSubstr("byte"));
  EXPECT_THAT(error_of("a.toml", "ground = "), HasSubstr("line 1"));
  EXPECT_THAT(error_of("a.json", "[]"), HasSubstr("ground"));
  EXPECT_THAT(error_of("a.json", "{}"), HasSubstr("ground"));
  EXPECT_THAT(error_of("a.json", R"({"ground": 3})"), HasSubstr("ground"));
  EXPECT_THAT(error_of("a.json", R"({"ground": [-1]})"), HasSubstr("0 to 65535"));
  EXPECT_THAT(error_of("a.json", R"({"ground": [1, 70000]})"), HasSubstr("70000"));
  EXPECT_THAT(error_of("a.json", R"({"ground": [1e999]})"), HasSubstr("beyond"));
  EXPECT_THAT(error_of("a.json", R"({"ground": [1], "ignored": [1]})"), HasSubstr("class 1"));
  EXPECT_THAT(error_of("a.json", R"({"ground": [1], "low_ground": [{"id": 2}]})"),
              HasSubstr("height"));
  EXPECT_THAT(error_of("a.yaml", "ground: [1]"), HasSubstr(".toml or .json"));
}

TEST_F(ProtocolFile, FindsAProtocolByNameOrFile) {
  Protocol protocol;
  EXPECT_TRUE(find_protocol("patchwork++", protocol).ok());
  EXPECT_EQ(protocol.name, "patchwork++");
  EXPECT_TRUE(find_protocol(put("own.json", R"({"ground": [7]})").string(), protocol).ok());
  EXPECT_EQ(protocol.name, "own");

  const Status status = find_protocol("semantickitti", protocol);
  EXPECT_THAT(status.message(), AllOf(HasSubstr("semantickitti"), HasSubstr("lidarseg")));
}

}  // namespace
}  // namespace flagstone::eval

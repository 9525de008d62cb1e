// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace flagstone::bench {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// Two scans of 1,000 and 3,000 points, one round.
Results example(std::string_view method = "patchwork") {
  Results results(method, {1000, 3000});
  results.rounds = 1;
  results.target = "avx2";
  results.core = 3;
  results.allocations = 2;
  results.bytes_held = 60000;
  for (const std::size_t scan : {0U, 1U}) {
    results.segment.times.add(0, scan, 0.4);
    results.segment.ground[scan] = 500;
    results.floor.times.add(0, scan, 0.1);
    results.scalar.times.add(0, scan, 1.6);
    for (StageResult& stage : results.stages) stage.times.add(0, scan, 0.05);
  }
  Measured tool(2);
  tool.times.add(0, 0, 8);
  tool.ground = {400, std::nullopt};
  results.external_tools.push_back({"there", tool, ""});
  results.external_tools.push_back({"gone", Measured(2), "No module named 'gone'"});
  return results;
}

TEST(Results, JsonContainsTimesRatiosAndTheReasonForExcludingATool) {
  const nlohmann::ordered_json json = to_json(example());

  EXPECT_EQ(json["method"], "patchwork");
  EXPECT_EQ(json["segment"]["median_ms"], 0.4);
  EXPECT_EQ(json["segment"]["p99_ms"], 0.4);
  EXPECT_EQ(json["segment"]["points_per_second"], 5e6);
  EXPECT_EQ(json["segment"]["ground"], 0.25);
  EXPECT_EQ(json["floor"]["median_ms"], 0.1);
  EXPECT_EQ(json["ratio_to_floor"], 4);
  EXPECT_EQ(json["ratio_to_scalar"], 0.25);
  EXPECT_EQ(json["stages"]["gather"]["median_ms"], 0.05);
  EXPECT_EQ(json["stages"]["gather"]["ratio"], 0.5);
  EXPECT_EQ(json["external_tools"]["there"]["ratio"], 20);
  EXPECT_EQ(json["external_tools"]["there"]["ground"], 0.4);
  EXPECT_EQ(json["external_tools"]["gone"]["left_out"], "No module named 'gone'");
  EXPECT_EQ(json["target"], "avx2");
  EXPECT_EQ(json["allocations"], 2);
  EXPECT_EQ(json["core"], 3);
}

TEST(Results, JsonIsNullForUnmeasuredValues) {
  Results results = example();
  results.allocations.reset();
  results.core.reset();
  results.floor = Measured(2);

  const auto json = nlohmann::json::parse(to_json(results).dump());

  EXPECT_TRUE(json["allocations"].is_null());
  EXPECT_TRUE(json["core"].is_null());
  EXPECT_TRUE(json["floor"]["median_ms"].is_null());
  EXPECT_TRUE(json["ratio_to_floor"].is_null());
}

TEST(Results, ContainOnlyTheStagesOfTheMethod) {
  const nlohmann::ordered_json patchwork = to_json(example())["stages"];
  const nlohmann::ordered_json surface = to_json(example("surface"))["stages"];

  EXPECT_EQ(patchwork.size(), 7U);
  EXPECT_EQ(surface.size(), stage_count);
  for (const char* stage : {"join", "refine", "measure"}) {
    EXPECT_FALSE(patchwork.contains(stage));
    EXPECT_EQ(surface[stage]["ratio"], 0.5);
  }
}

TEST(Results, TextOfSurfaceNamesTheMethodAndHasARowPerStage) {
  const std::string text = to_text(example("surface"));

  EXPECT_THAT(text, testing::StartsWith("Surface with avx2, 1 thread;"));
  for (std::size_t stage = 0; stage < stage_count; ++stage) {
    EXPECT_THAT(text, ContainsRegex(std::string("\n") + to_string(static_cast<Stage>(stage)) +
                                    " +50.0 +50.0 +25.000 +0.50 +10.0\n"));
  }
}

TEST(Results, TextHasARowPerCandidateAndStage) {
  const std::string text = to_text(example());

  EXPECT_THAT(text, HasSubstr("Patchwork with avx2, 1 thread; 2 scans of 2000 points (mean) in "
                              "rotation, 1 round after"));
  EXPECT_THAT(text, HasSubstr("pinned to core 3"));
  EXPECT_THAT(text, ContainsRegex("segment +0.400 +0.400 +5.0 +4.00 +1.000 +25.00 +2\n"));
  EXPECT_THAT(text, ContainsRegex("read-only baseline +0.100 +0.100 +20.0 +1.00 +0.250 +- +2\n"));
  EXPECT_THAT(text, ContainsRegex("there +8.000 +8.000 +0.1 +80.00 +20.000 +40.00 +1\n"));
  for (const char* stage : {"bin", "group", "gather", "seed", "moments", "solve", "label"}) {
    EXPECT_THAT(text,
                ContainsRegex(std::string("\n") + stage + " +50.0 +50.0 +25.000 +0.50 +14.3\n"));
  }
  EXPECT_THAT(text, AllOf(HasSubstr("after warm-up: 2\n"), HasSubstr("20.0 bytes per point"),
                          HasSubstr("gone excluded: No module named 'gone'\n")));
}

}  // namespace
}  // namespace flagstone::bench

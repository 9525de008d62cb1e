// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace flagstone::app {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

constexpr std::array edges = {0.0f, 2.0f, 5.0f};
const std::string full_bar(40, '#');
const std::string half_bar = std::string(20, '#') + std::string(20, ' ');

TEST(Histogram, EachBinHasBoundsABarAndAPercentage) {
  const std::array values = {1.0f, 3.0f, 4.0f};

  EXPECT_THAT(lines_of(histogram_text(values, edges)),
              ElementsAre("            0 .. 2 m  " + half_bar + "   33.3 %",
                          "            2 .. 5 m  " + full_bar + "   66.7 %"));
}

TEST(Histogram, EdgeBelongsToTheBinAboveExceptTheLast) {
  const std::array values = {0.0f, 2.0f, 5.0f};

  EXPECT_THAT(lines_of(histogram_text(values, edges)),
              ElementsAre(HasSubstr("33.3 %"), HasSubstr("66.7 %")));
}

TEST(Histogram, CountsValuesOutsideOnASeparateLine) {
  const std::array values = {-1.0f, 1.0f, 6.0f, 1e30f};

  EXPECT_THAT(lines_of(histogram_text(values, edges)),
              ElementsAre(HasSubstr("25.0 %"), HasSubstr(" 0.0 %"),
                          testing::AllOf(HasSubstr("outside"), HasSubstr("75.0 %"))));
}

TEST(Histogram, OfNoValuesIsAMessage) { EXPECT_EQ(histogram_text({}, edges), "  no points\n"); }

TEST(RoundEdges, HaveARoundWidthAndContainTheValues) {
  const std::array values = {-1.9f, 0.3f, 2.2f};

  EXPECT_THAT(round_edges(values, 4), ElementsAre(-2, 0, 2, 4));
}

TEST(RoundEdges, ExcludeTheOutermostThousandth) {
  std::vector<float> values(2000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 10);
  values[5] = 1e6f;
  values[6] = -1e6f;

  const std::vector<float> found = round_edges(values, 10);

  EXPECT_GE(found.front(), -1);
  EXPECT_LE(found.back(), 11);
}

TEST(RoundEdges, ContainTheLargestFloats) {
  constexpr float most = std::numeric_limits<float>::max();
  for (const std::vector<float>& values :
       {std::vector{most}, std::vector{-most}, std::vector{-most, most}, std::vector{1e30f}}) {
    const std::vector<float> found = round_edges(values, 16);

    ASSERT_GE(found.size(), 2U);
    EXPECT_LE(found.front(), values.front());
    EXPECT_GE(found.back(), values.back());
  }
}

RC_GTEST_PROP(RoundEdges, AscendAreFewAndContainNearlyAllValues, ()) {
  const auto raw = *rc::gen::container<std::vector<int>>(rc::gen::arbitrary<int>());
  const auto unit = *rc::gen::element(1e-3f, 0.1f, 1.0f, 1e6f, 1e28f);
  const auto count = *rc::gen::inRange<std::size_t>(1, 30);
  std::vector<float> values;
  for (const int value : raw) values.push_back(static_cast<float>(value) * unit);

  const std::vector<float> found = round_edges(values, count);

  RC_ASSERT(found.size() >= 2U);
  RC_ASSERT(found.size() <= count + 3);
  RC_ASSERT(std::ranges::is_sorted(found));
  for (const float value : values) {
    RC_ASSERT(value >= found.front());
    RC_ASSERT(value <= found.back());
  }
}

}  // namespace
}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/html.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace flagstone::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

TEST(Html, EscapesMarkup) {
  EXPECT_EQ(escaped(R"(<b a="1" b='2'>&amp;</b>)"),
            "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;amp;&lt;/b&gt;");
}

TEST(Html, KeepsOtherText) { EXPECT_EQ(escaped("00/000123 σ é"), "00/000123 σ é"); }

TEST(Html, JsonInAScriptCannotEndIt) {
  const Json value = {{"</script><!--", "</SCRIPT>"}};

  const std::string json = script_json(value);

  EXPECT_THAT(json, Not(HasSubstr("<")));
  EXPECT_EQ(Json::parse(json), value);
}

TEST(Html, JsonOfBytesThatAreNotUtf8IsValid) {
  EXPECT_EQ(Json::parse(script_json("a\xFF")), "a\uFFFD");
}

TEST(Html, ShowsRatiosInPercentWithTwoDecimals) {
  EXPECT_EQ(percent_text(0.951234), "95.12");
  EXPECT_EQ(percent_text(1), "100.00");
  EXPECT_EQ(percent_text(0.0), "0.00");
}

TEST(Html, ShowsRatesBelow1000WithOneDecimal) {
  EXPECT_EQ(number_text(55.23), "55.2");
  EXPECT_EQ(number_text(1240.4), "1240");
  EXPECT_EQ(number_text(10), "10");
}

TEST(Html, ShowsADashForAMissingNumber) {
  EXPECT_EQ(percent_text(nullptr), no_number);
  EXPECT_EQ(number_text(nullptr), no_number);
}

std::string encoded(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

// RFC 4648, section 10.
TEST(Base64, MatchesTheTestVectorsOfTheStandard) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Base64, KeepsBytesWithTheirHighestBitSet) {
  constexpr std::array bytes = {std::byte{0xFB}, std::byte{0xFF}, std::byte{0xFE}};
  EXPECT_EQ(base64(bytes), "+//+");
}

}  // namespace
}  // namespace flagstone::report

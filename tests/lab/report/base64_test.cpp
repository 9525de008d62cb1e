// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/base64.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace flagstone::report {
namespace {

std::string encoded(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

// RFC 4648, section 10.
TEST(Base64, GivesTheTestVectorsOfItsStandard) {
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/wrapped.hpp"

#include <gtest/gtest.h>

namespace flagstone::app {
namespace {

TEST(Wrapped, BreaksLinesAtSpacesBeforeTheWidth) {
  EXPECT_EQ(wrapped("one two three", {.width = 7}), "one two\nthree");
  EXPECT_EQ(wrapped("one two three", {.width = 6}), "one\ntwo\nthree");
  EXPECT_EQ(wrapped("one two three", {.width = 13}), "one two three");
}

TEST(Wrapped, IndentsAllLinesExceptTheFirst) {
  EXPECT_EQ(wrapped("one two three", {.column = 4, .indent = 2, .width = 7}),
            "one\n  two\n  three");
}

TEST(Wrapped, NeverBreaksAWord) {
  EXPECT_EQ(wrapped("extraordinary words", {.width = 5}), "extraordinary\nwords");
  EXPECT_EQ(wrapped("", {.width = 5}), "");
}

}  // namespace
}  // namespace flagstone::app

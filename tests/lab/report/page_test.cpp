// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace flagstone::report {
namespace {

using testing::HasSubstr;

TEST(Template, ReplacesSlotsByTheirValues) {
  constexpr std::array slots = {Slot{"a", "1"}, Slot{"b", "2"}};
  EXPECT_EQ(fill("x{{a}}y{{b}}{{a}}z", slots), "x1y21z");
}

TEST(Template, DoesNotReplaceSlotsInValues) {
  constexpr std::array slots = {Slot{"a", "{{b}}"}, Slot{"b", "2"}};
  EXPECT_EQ(fill("{{a}}", slots), "{{b}}");
}

TEST(Template, RejectsANameWithoutSlot) { EXPECT_THROW((void)fill("{{a}}", {}), std::logic_error); }

TEST(Page, EscapesItsTitle) {
  EXPECT_THAT(page("a < b", "", {}, ""), HasSubstr("<title>a &lt; b</title>"));
}

TEST(Page, ForbidsTheBrowserToLoadAnything) {
  EXPECT_THAT(page("", "", {}, ""), HasSubstr("default-src 'none'"));
}

}  // namespace
}  // namespace flagstone::report

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/simd_target.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "forced_target.hpp"

namespace flagstone {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

TEST(SimdTarget, ListsEachInstructionSetOnce) {
  const std::vector<std::string> targets = simd_targets();

  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(std::set<std::string>(targets.begin(), targets.end()).size(), targets.size());
}

TEST(SimdTarget, NamesAreLowerCaseWithoutSpaces) {
  for (const std::string& name : simd_targets()) {
    EXPECT_THAT(name, testing::Not(testing::IsEmpty()));
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
        << name;
  }
}

#if defined(__x86_64__)
TEST(SimdTarget, HasTheDocumentedNamesOnX86AndEndsWithPlainCpp) {
  EXPECT_THAT(simd_targets(), testing::Each(AnyOf("avx3", "avx2", "sse4", "scalar")));
  EXPECT_EQ(simd_targets().back(), "scalar");
}
#endif

TEST(SimdTarget, IsTheBestUnlessAnotherIsForced) {
  EXPECT_EQ(simd_target(), simd_targets().front());
}

TEST(SimdTarget, IsTheForcedTarget) {
  for (const std::string& name : simd_targets()) {
    const tests::ForcedTarget forced(name);
    EXPECT_EQ(simd_target(), name);
  }
  EXPECT_EQ(simd_target(), simd_targets().front());
}

TEST(SimdTarget, ListsAllTargetsWhileOneIsForced) {
  const std::vector<std::string> all = simd_targets();
  for (const std::string& name : all) {
    const tests::ForcedTarget forced(name);
    EXPECT_EQ(simd_targets(), all) << "while " << name << " is forced";
  }
}

TEST(SimdTarget, CanSwitchFromOneForcedTargetToAnother) {
  const std::vector<std::string> all = simd_targets();
  const tests::ForcedTarget first(all.back());
  for (const std::string& name : all) {
    use_simd_target(name);
    EXPECT_EQ(simd_target(), name);
  }
}

TEST(SimdTarget, RejectsUnknownNamesOnOneLineThatListsTheTargets) {
  for (const std::string name : {"avx9000", "AVX2", "scalar ", " ", "best"}) {
    try {
      use_simd_target(name);
      use_simd_target("");
      ADD_FAILURE() << "accepted \"" << name << '"';
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      EXPECT_THAT(message, HasSubstr('"' + name + '"'));
      for (const std::string& known : simd_targets()) EXPECT_THAT(message, HasSubstr(known));
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
}

TEST(SimdTarget, ARejectedNameChangesNothing) {
  const std::string last = simd_targets().back();
  const tests::ForcedTarget forced(last);

  EXPECT_THROW(use_simd_target("no such thing"), std::invalid_argument);

  EXPECT_EQ(simd_target(), last);
}

}  // namespace
}  // namespace flagstone

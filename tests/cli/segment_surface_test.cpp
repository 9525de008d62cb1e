// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;

class SegmentSurface : public testing::Test {
 protected:
  SegmentSurface() { put_scan(folder_ / "scan.bin"); }

  [[nodiscard]] Outcome segment(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"segment", (folder_ / "scan.bin").string(), "--output",
                                          (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_F(SegmentSurface, IsRefusedWhereTheMethodMakesNone) {
  for (const std::string option : {"--heights", "--surface"}) {
    const Outcome outcome = segment({"--method", "patchwork", option});

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err,
                is_one_line_with(option + ": method patchwork makes no surface; --method surface"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(SegmentSurface, ResolutionIsRefusedWithoutASurface) {
  const Outcome outcome = segment({"--surface-resolution", "0.5"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, is_one_line_with("--surface"));
}

TEST_F(SegmentSurface, ResolutionIsRefusedOutOfRange) {
  for (const std::string resolution : {"0.09", "10.1", "-1", "nan", "fine"}) {
    const Outcome outcome = segment({"--surface", "--surface-resolution", resolution});

    EXPECT_EQ(outcome.exit_code, 2) << resolution;
    EXPECT_THAT(outcome.err, is_one_line_with("--surface-resolution")) << resolution;
  }
}

}  // namespace
}  // namespace flagstone::cli

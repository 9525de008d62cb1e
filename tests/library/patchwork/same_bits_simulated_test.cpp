// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "flagstone/patchwork.hpp"
#include "forced_target.hpp"
#include "lab/sim/drive.hpp"
#include "library/core/simd_target.hpp"
#include "library/patchwork/outcome.hpp"

namespace flagstone {
namespace {

TEST(SimulatedScans, HaveTheSameBitsOnEveryInstructionSetByAnyNumberOfThreads) {
  const sim::SimulatedScan scan = sim::simulate_street(4, 2);
  const CloudView cloud(scan.xyzi.data(), scan.size(), 4);
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    const PatchworkConfig config = PatchworkConfig::preset(name);
    const tests::Outcome expected = tests::segmented(config, cloud);
    for (const std::string& target : simd_targets()) {
      const tests::ForcedTarget forced(target);
      for (const unsigned threads : {1U, 2U, 7U}) {
        Patchwork patchwork(config, threads);
        EXPECT_TRUE(tests::is_same(expected, tests::segmented(patchwork, cloud)))
            << name << ", " << target << ", " << threads << " threads";
      }
    }
  }
}

}  // namespace
}  // namespace flagstone

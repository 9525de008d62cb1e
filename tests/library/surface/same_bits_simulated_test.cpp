// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "flagstone/surface.hpp"
#include "forced_target.hpp"
#include "lab/sim/drive.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/outcome.hpp"

namespace flagstone {
namespace {

TEST(SurfaceOfSimulatedScans, HasTheSameBitsOnEveryInstructionSetByAnyNumberOfThreads) {
  const sim::SimulatedScan scan = sim::simulate_street(4, 2);
  const CloudView cloud(scan.xyzi.data(), scan.size(), 4);
  const tests::SurfaceOutcome expected = tests::segmented(SurfaceConfig(), cloud);
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    for (const unsigned threads : {1U, 2U, 7U}) {
      Surface segmenter({}, threads);
      EXPECT_TRUE(tests::is_same(expected, tests::segmented(segmenter, cloud)))
          << target << ", " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace flagstone

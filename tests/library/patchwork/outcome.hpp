// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "flagstone/patchwork.hpp"

namespace flagstone::tests {

/// All that a segmentation says.
struct Outcome {
  std::vector<Label> labels;
  std::vector<Patch> patches;
};

/// What `patchwork` makes of the cloud.
Outcome segmented(Patchwork& patchwork, CloudView cloud);

/// What a new Patchwork makes of it.
Outcome segmented(const PatchworkConfig& config, CloudView cloud);

/// Byte by byte, patches included; a failure names the first label or patch that is not the same.
testing::AssertionResult is_same(const Outcome& expected, const Outcome& found);

}  // namespace flagstone::tests

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "flagstone/surface.hpp"

namespace flagstone::tests {

/// All that a segmentation by `surface` says.
struct SurfaceOutcome {
  std::vector<Label> labels;
  std::vector<Patch> patches;
  std::vector<float> heights;
  std::vector<GroundSurface::Grid> grids;
};

/// What `segmenter` makes of the cloud. Fails where the counts of labels are not those of the
/// labels, or where there is not one height a point.
SurfaceOutcome segmented(Surface& segmenter, CloudView cloud);

/// What a new segmenter makes of it.
SurfaceOutcome segmented(const SurfaceConfig& config, CloudView cloud);

/// Byte by byte: labels, patches, heights and the grids of the surface; a failure names the first
/// that is not the same.
testing::AssertionResult is_same(const SurfaceOutcome& expected, const SurfaceOutcome& found);

}  // namespace flagstone::tests

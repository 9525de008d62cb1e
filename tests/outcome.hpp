// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"

namespace flagstone::tests {

/// Everything a segmentation contains. Methods without heights leave `heights` and `grids` empty.
struct Outcome {
  std::vector<Label> labels;
  std::vector<Patch> patches;
  std::vector<float> heights;
  std::vector<GroundSurface::Grid> grids;
};

/// Segments the cloud. Fails if the counts of labels do not match the labels, or if there are
/// heights but not one per point.
Outcome segmented(Segmenter& segmenter, CloudView cloud);

/// Segments the cloud with a new segmenter.
inline Outcome segmented(const PatchworkConfig& config, CloudView cloud) {
  Patchwork patchwork(config);
  return segmented(patchwork, cloud);
}
inline Outcome segmented(const SurfaceConfig& config, CloudView cloud) {
  Surface surface(config);
  return segmented(surface, cloud);
}

/// Compares labels, patches, heights and grids byte by byte. A failure names the first difference.
testing::AssertionResult is_same(const Outcome& expected, const Outcome& found);

}  // namespace flagstone::tests

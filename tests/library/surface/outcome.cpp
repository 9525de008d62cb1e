// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/outcome.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace flagstone::tests {
namespace {

bool has_same_bytes(const Patch& a, const Patch& b) {
  return std::ranges::equal(std::as_bytes(std::span(&a, 1)), std::as_bytes(std::span(&b, 1)));
}

/// Index of the first number with other bits; the size if there is none.
std::size_t first_difference(std::span<const float> a, std::span<const float> b) {
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  return static_cast<std::size_t>(std::ranges::mismatch(a, b, {}, bits, bits).in1 - a.begin());
}

testing::AssertionResult is_same_grid(const GroundSurface::Grid& expected,
                                      const GroundSurface::Grid& found) {
  if (expected.cell != found.cell || expected.width != found.width) {
    return testing::AssertionFailure() << found.width << " cells of " << found.cell << " m";
  }
  const std::size_t height = first_difference(expected.heights, found.heights);
  if (height != expected.heights.size()) {
    return testing::AssertionFailure() << "height " << height << " is " << found.heights[height]
                                       << ", not " << expected.heights[height];
  }
  const std::size_t confidence = first_difference(expected.confidences, found.confidences);
  if (confidence != expected.confidences.size()) {
    return testing::AssertionFailure()
           << "confidence " << confidence << " is " << found.confidences[confidence] << ", not "
           << expected.confidences[confidence];
  }
  return testing::AssertionSuccess();
}

}  // namespace

SurfaceOutcome segmented(Surface& segmenter, CloudView cloud) {
  Segmentation result;
  EXPECT_TRUE(segmenter.segment(cloud, result).ok());
  std::array<std::size_t, label_count> counts{};
  for (const Label label : result.labels()) ++counts.at(static_cast<std::size_t>(label));
  for (std::size_t code = 0; code < label_count; ++code) {
    EXPECT_EQ(result.count(static_cast<Label>(code)), counts.at(code)) << "label " << code;
  }
  EXPECT_EQ(result.labels().size(), cloud.size());
  EXPECT_EQ(result.heights().size(), cloud.size());
  return {.labels = {result.labels().begin(), result.labels().end()},
          .patches = {result.patches().begin(), result.patches().end()},
          .heights = {result.heights().begin(), result.heights().end()},
          .grids = {result.surface().grids().begin(), result.surface().grids().end()}};
}

SurfaceOutcome segmented(const SurfaceConfig& config, CloudView cloud) {
  Surface segmenter(config);
  return segmented(segmenter, cloud);
}

testing::AssertionResult is_same(const SurfaceOutcome& expected, const SurfaceOutcome& found) {
  if (expected.labels.size() != found.labels.size()) {
    return testing::AssertionFailure() << found.labels.size() << " labels";
  }
  const auto label = std::ranges::mismatch(expected.labels, found.labels);
  if (label.in1 != expected.labels.end()) {
    return testing::AssertionFailure()
           << "label " << label.in1 - expected.labels.begin() << " is " << to_string(*label.in2)
           << ", not " << to_string(*label.in1);
  }
  if (expected.patches.size() != found.patches.size()) {
    return testing::AssertionFailure() << found.patches.size() << " patches";
  }
  const auto patch = std::ranges::mismatch(expected.patches, found.patches, has_same_bytes);
  if (patch.in1 != expected.patches.end()) {
    return testing::AssertionFailure()
           << "patch " << patch.in1 - expected.patches.begin() << " is not the same";
  }
  const std::size_t height = first_difference(expected.heights, found.heights);
  if (height != expected.heights.size() || found.heights.size() != height) {
    return testing::AssertionFailure() << "height of point " << height << " is not the same";
  }
  if (expected.grids.size() != found.grids.size()) {
    return testing::AssertionFailure() << found.grids.size() << " grids";
  }
  for (std::size_t i = 0; i < expected.grids.size(); ++i) {
    const testing::AssertionResult same = is_same_grid(expected.grids[i], found.grids[i]);
    if (!same) return testing::AssertionFailure() << "grid " << i << ": " << same.message();
  }
  return testing::AssertionSuccess();
}

}  // namespace flagstone::tests

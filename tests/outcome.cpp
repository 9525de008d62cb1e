// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "outcome.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace flagstone::tests {
namespace {

// Every byte of a patch belongs to a field. Padding could differ, or hide a difference.
static_assert(sizeof(Patch) == 3 * sizeof(std::uint16_t) + sizeof(Verdict) +
                                   3 * sizeof(std::uint32_t) + 15 * sizeof(float));

bool has_same_bytes(const Patch& a, const Patch& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Index of the first number with different bits; the size if there is none.
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

Outcome segmented(Segmenter& segmenter, CloudView cloud) {
  Segmentation result;
  EXPECT_TRUE(segmenter.segment(cloud, result).ok());
  std::array<std::size_t, label_count> counts{};
  for (const Label label : result.labels()) ++counts.at(static_cast<std::size_t>(label));
  for (std::size_t code = 0; code < label_count; ++code) {
    EXPECT_EQ(result.count(static_cast<Label>(code)), counts.at(code)) << "label " << code;
  }
  EXPECT_EQ(result.labels().size(), cloud.size());
  if (!result.heights().empty()) {
    EXPECT_EQ(result.heights().size(), cloud.size());
  }
  return {.labels = {result.labels().begin(), result.labels().end()},
          .patches = {result.patches().begin(), result.patches().end()},
          .heights = {result.heights().begin(), result.heights().end()},
          .grids = {result.surface().grids().begin(), result.surface().grids().end()}};
}

testing::AssertionResult is_same(const Outcome& expected, const Outcome& found) {
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
           << "patch " << patch.in1 - expected.patches.begin() << " (zone " << patch.in1->zone
           << ", ring " << patch.in1->ring << ", sector " << patch.in1->sector << ") differs";
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/outcome.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace flagstone::tests {
namespace {

// Every byte of a patch is one of its fields': there is no padding that could differ or hide a
// difference.
static_assert(sizeof(Patch) == 3 * sizeof(std::uint16_t) + sizeof(Verdict) +
                                   3 * sizeof(std::uint32_t) + 15 * sizeof(float));

bool has_same_bytes(const Patch& a, const Patch& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

Outcome segmented(Patchwork& patchwork, CloudView cloud) {
  Segmentation result;
  EXPECT_TRUE(patchwork.segment(cloud, result).ok());
  std::array<std::size_t, label_count> counts{};
  for (const Label label : result.labels()) ++counts.at(static_cast<std::size_t>(label));
  for (std::size_t code = 0; code < label_count; ++code) {
    EXPECT_EQ(result.count(static_cast<Label>(code)), counts.at(code)) << "label " << code;
  }
  return {{result.labels().begin(), result.labels().end()},
          {result.patches().begin(), result.patches().end()}};
}

Outcome segmented(const PatchworkConfig& config, CloudView cloud) {
  Patchwork patchwork(config);
  return segmented(patchwork, cloud);
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
  if (patch.in1 == expected.patches.end()) return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "patch " << patch.in1 - expected.patches.begin() << " (zone " << patch.in1->zone
         << ", ring " << patch.in1->ring << ", sector " << patch.in1->sector << ") is not the same";
}

}  // namespace flagstone::tests

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/oracle_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "flagstone/patchwork.hpp"
#include "library/patchwork/oracle.hpp"

namespace flagstone::oracle {

Difference& Difference::operator+=(const Difference& other) {
  points += other.points;
  different_labels += other.different_labels;
  patches += other.patches;
  different_verdicts += other.different_verdicts;
  largest_normal_error = std::max(largest_normal_error, other.largest_normal_error);
  return *this;
}

Difference compare(CloudView cloud, const PatchworkConfig& config) {
  const Answer expected = segment(cloud, config);
  Patchwork patchwork(config);
  Segmentation result;
  EXPECT_TRUE(patchwork.segment(cloud, result).ok());

  Difference difference{.points = cloud.size(), .patches = expected.bins.size()};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    difference.different_labels += result.labels()[i] != expected.labels[i];
  }
  if (result.patches().size() != expected.bins.size()) {
    difference.different_verdicts = difference.patches;
    return difference;
  }
  for (std::size_t i = 0; i < expected.bins.size(); ++i) {
    const Patch& patch = result.patches()[i];
    const Bin& bin = expected.bins[i];
    const bool same = patch.zone == bin.zone && patch.ring == bin.ring &&
                      patch.sector == bin.sector && patch.verdict == bin.verdict;
    difference.different_verdicts += !same;
    // A point within rounding of a margin is in only one of the two sets, which rotates the plane.
    const bool same_set = std::ranges::all_of(
        bin.points, [&](std::size_t k) { return result.labels()[k] == expected.labels[k]; });
    if (!same || !same_set || !patch.is_ground()) continue;
    const double cosine = patch.normal[0] * bin.normal.x() + patch.normal[1] * bin.normal.y() +
                          patch.normal[2] * bin.normal.z();
    difference.largest_normal_error = std::max(difference.largest_normal_error, 1 - cosine);
  }
  return difference;
}

void expect_agreement(const std::string& what, const Difference& difference) {
  std::printf("%s: %zu of %zu labels and %zu of %zu patch states differ from the oracle\n",
              what.c_str(), difference.different_labels, difference.points,
              difference.different_verdicts, difference.patches);
  EXPECT_LE(difference.different_labels * 10000, difference.points) << what;
  EXPECT_LE(difference.different_verdicts * 1000, difference.patches) << what;
  EXPECT_LT(difference.largest_normal_error, 1e-5) << what;
}

}  // namespace flagstone::oracle

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/batch_of.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "library/plane_fits/sorted_scan.hpp"

namespace flagstone::tests {

plane_fits::BinBatch batch_of(const std::vector<std::vector<float>>& heights) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<float>(random() >> 8U) / 16777216.0f; };
  std::vector<Point> cloud;
  for (std::size_t bin = 0; bin < heights.size(); ++bin) {
    for (const float z : heights[bin]) {
      const float turn = (static_cast<float>(bin) + 0.02f + 0.96f * unit()) / 16;
      const float theta = 6.2831853f * turn - 3.1415927f;
      const float rho = 5 + 5 * unit();
      cloud.push_back({rho * std::cos(theta), rho * std::sin(theta), z});
    }
  }
  const SortedScan sorted(cloud, sixteen_bins());

  plane_fits::BinBatch batch;
  batch.reserve(cloud.size());
  for (std::uint32_t bin = 0; bin < heights.size(); ++bin) {
    batch.add(bin, sorted.groups.size(bin));
  }
  batch.gather(sorted.scan, sorted.groups);
  return batch;
}

}  // namespace flagstone::tests

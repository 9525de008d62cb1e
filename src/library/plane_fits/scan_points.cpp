// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/scan_points.hpp"

#include <algorithm>

namespace flagstone::plane_fits {

void ScanPoints::reserve(std::size_t points) {
  const std::size_t chunks = chunk_count(points);
  for (Buffer<float>* coordinate : {&x_, &y_, &z_}) coordinate->reserve(points + 2 * slack);
  starts_.reserve(chunks * (chunk_size + slack) + slack);
  run_counts_.reserve(chunks);
}

PointSlice ScanPoints::stretch(CloudView cloud, std::size_t chunk) noexcept {
  const std::size_t begin = chunk * chunk_size;
  return {.cloud = cloud,
          .begin = begin,
          .end = std::min(begin + chunk_size, cloud.size()),
          .x = x_.data() + begin,
          .y = y_.data() + begin,
          .z = z_.data() + begin,
          .starts = starts_.data() + chunk * (chunk_size + slack)};
}

}  // namespace flagstone::plane_fits

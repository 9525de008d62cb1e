// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/scan_voxels.hpp"

#include <algorithm>
#include <bit>

namespace flagstone {

void ScanVoxels::clear() {
  size_ = 1;
  std::ranges::fill(slots_, none);
}

void ScanVoxels::grow(std::size_t points) {
  constexpr std::size_t smallest = 1024;
  const std::size_t slots = std::bit_ceil(std::max(smallest, 2 * (size_ + points)));
  voxels_.resize(slots / 2 + 1);
  slots_.assign(slots, none);
  for (std::uint32_t i = 1; i < size_; ++i) slot_of(voxels_[i].at) = i;
}

}  // namespace flagstone

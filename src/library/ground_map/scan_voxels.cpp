// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/scan_voxels.hpp"

#include <algorithm>

namespace flagstone {

void ScanVoxels::clear() {
  voxels_.clear();
  std::ranges::fill(slots_, none);
}

void ScanVoxels::grow() {
  constexpr std::size_t smallest = 1024;
  slots_.assign(slots_.empty() ? smallest : 2 * slots_.size(), none);
  for (std::uint32_t i = 0; i < voxels_.size(); ++i) {
    slots_[slot_of(voxels_[i].tile, voxels_[i].key)] = i;
  }
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "flagstone/ground_map.hpp"

namespace flagstone {

/// For hash tables of tiles.
struct TileIndexHash {
  std::size_t operator()(TileIndex tile) const noexcept {
    const auto mixed = static_cast<std::uint64_t>(tile.x) * 0x9E3779B97F4A7C15U ^
                       static_cast<std::uint64_t>(tile.y) * 0xC2B2AE3D27D4EB4FU;
    return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
  }
};

}  // namespace flagstone

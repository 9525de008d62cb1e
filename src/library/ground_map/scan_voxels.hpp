// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flagstone {

/// The voxels that one scan measures, each with the number of its points. Reuses its memory.
class ScanVoxels {
 public:
  struct Voxel {
    std::uint32_t tile, key;    ///< see PointVoxels
    std::uint32_t ground, all;  ///< number of points
  };

  /// Removes all voxels.
  void clear();

  /// Counts a point and returns the index of its voxel. May throw std::bad_alloc.
  std::uint32_t count(std::uint32_t tile, std::uint32_t key, bool is_ground) {
    if (2 * (voxels_.size() + 1) > slots_.size()) grow();
    std::uint32_t& slot = slots_[slot_of(tile, key)];
    if (slot == none) {
      voxels_.push_back({.tile = tile, .key = key, .ground = 0, .all = 0});
      slot = static_cast<std::uint32_t>(voxels_.size() - 1);
    }
    Voxel& voxel = voxels_[slot];
    voxel.ground += is_ground ? 1U : 0U;
    ++voxel.all;
    return slot;
  }

  /// In the order of their first points.
  [[nodiscard]] const std::vector<Voxel>& voxels() const noexcept { return voxels_; }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return voxels_.capacity() * sizeof(Voxel) + slots_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  // The slot of a voxel, or the empty slot for it: linear probing.
  [[nodiscard]] std::size_t slot_of(std::uint32_t tile, std::uint32_t key) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t mixed = (std::uint64_t{tile} << 32U | key) * 0x9E3779B97F4A7C15U;
    auto slot = static_cast<std::size_t>(mixed >> 32U) & mask;
    while (slots_[slot] != none &&
           (voxels_[slots_[slot]].key != key || voxels_[slots_[slot]].tile != tile)) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  void grow();

  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> slots_;  // indices of voxels; a power of two, or empty
};

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "library/ground_map/tile_index_hash.hpp"

namespace flagstone {

/// Index of a voxel within its tile: 7 bits of x, 7 of y, 17 of z. The vertical index wraps around:
/// voxels that are 2^17 apart, 7.8 km with the default size, share a key.
class VoxelKey {
 public:
  static constexpr unsigned horizontal_bits = 7;
  static constexpr unsigned vertical_bits = 17;
  static constexpr std::uint32_t largest = (1U << (2 * horizontal_bits + vertical_bits)) - 1;

  /// `x` and `y` are below 2^7.
  static constexpr std::uint32_t of(std::uint32_t x, std::uint32_t y, std::uint32_t z) noexcept {
    constexpr std::uint32_t vertical = (1U << vertical_bits) - 1;
    return (z & vertical) << (2 * horizontal_bits) | y << horizontal_bits | x;
  }
  static constexpr std::uint32_t x(std::uint32_t key) noexcept {
    return key & ((1U << horizontal_bits) - 1);
  }
  static constexpr std::uint32_t y(std::uint32_t key) noexcept {
    return key >> horizontal_bits & ((1U << horizontal_bits) - 1);
  }
};

/// The sums of votes in a square of voxels: a hash table with linear probing, 8 bytes per entry and
/// at least three eighths full when it has grown.
class VoxelTile {
 public:
  struct Entry {
    std::uint32_t key = no_key;
    std::int32_t sum = 0;
  };

  /// Number of voxels along one side.
  static constexpr std::int64_t width = std::int64_t{1} << VoxelKey::horizontal_bits;

  /// Sums stop here, after half a million scans.
  static constexpr std::int64_t largest_sum = 1 << 30;

  /// Adds to the sum of a voxel and returns it. May throw std::bad_alloc.
  std::int32_t add(std::uint32_t key, std::int32_t vote) {
    if (4 * (size_ + 1) > 3 * entries_.size()) grow();
    Entry& entry = entries_[slot_of(key)];
    size_ += entry.key == no_key ? 1U : 0U;
    entry.key = key;
    entry.sum = limited(std::int64_t{entry.sum} + vote);
    return entry.sum;
  }

  /// The sum of a voxel; 0 without votes.
  [[nodiscard]] std::int32_t sum(std::uint32_t key) const noexcept {
    if (entries_.empty()) return 0;
    const Entry& entry = entries_[slot_of(key)];
    return entry.key == no_key ? 0 : entry.sum;
  }

  /// Loads the entry of a key into the cache.
  void prefetch(std::uint32_t key) const noexcept {
    if (!entries_.empty()) __builtin_prefetch(&entries_[first_slot_of(key)]);
  }

  /// The voxels, sorted by key. May throw std::bad_alloc.
  [[nodiscard]] std::vector<Entry> sorted() const {
    std::vector<Entry> voxels;
    voxels.reserve(size_);
    std::ranges::copy_if(entries_, std::back_inserter(voxels),
                         [](const Entry& entry) { return entry.key != no_key; });
    std::ranges::sort(voxels, {}, &Entry::key);
    return voxels;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return entries_.capacity() * sizeof(Entry); }

 private:
  static constexpr std::uint32_t no_key = ~std::uint32_t{0};  // a key has 31 bits

  static std::int32_t limited(std::int64_t sum) noexcept {
    return static_cast<std::int32_t>(std::clamp(sum, -largest_sum, largest_sum));
  }

  // The upper bits of the product depend on all bits of the key.
  [[nodiscard]] std::size_t first_slot_of(std::uint32_t key) const noexcept {
    return (key * 0x9E3779B1U) >> shift_;
  }
  // The slot of a key, or the empty slot for it.
  [[nodiscard]] std::size_t slot_of(std::uint32_t key) const noexcept {
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = first_slot_of(key);
    while (entries_[slot].key != key && entries_[slot].key != no_key) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    constexpr std::size_t smallest = 64;
    std::vector<Entry> larger(entries_.empty() ? smallest : 2 * entries_.size());
    entries_.swap(larger);
    shift_ = 32U - static_cast<unsigned>(std::countr_zero(entries_.size()));
    for (const Entry& entry : larger) {
      if (entry.key != no_key) entries_[slot_of(entry.key)] = entry;
    }
  }

  std::vector<Entry> entries_;  // the number of entries is a power of two, or 0
  std::size_t size_ = 0;
  unsigned shift_ = 0;
};

/// The tiles that have votes.
using VoxelTiles = std::unordered_map<TileIndex, VoxelTile, TileIndexHash>;

}  // namespace flagstone

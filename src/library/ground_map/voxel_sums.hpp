// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flagstone {

/// A sum per voxel, in a hash table with linear probing. Growing may throw std::bad_alloc.
template <class Sum>
class VoxelSums {
 public:
  struct Entry {
    std::uint64_t key = no_key;
    Sum sum{};
  };

  /// No voxel has this key.
  static constexpr std::uint64_t no_key = ~std::uint64_t{0};

  /// The sum of a voxel; a new one is 0. The reference is valid until the next call.
  Sum& at(std::uint64_t key) {
    if (2 * (size_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[slot_of(key)];
    if (entry.key == no_key) {
      entry.key = key;
      entry.sum = {};
      ++size_;
    }
    return entry.sum;
  }

  /// The sum of a voxel, or null.
  [[nodiscard]] const Sum* find(std::uint64_t key) const noexcept {
    if (entries_.empty()) return nullptr;
    const Entry& entry = entries_[slot_of(key)];
    return entry.key == no_key ? nullptr : &entry.sum;
  }

  /// Calls `work(key, sum)` for each voxel, in any order.
  template <class Work>
  void for_each(const Work& work) const {
    for (const Entry& entry : entries_) {
      if (entry.key != no_key) work(entry.key, entry.sum);
    }
  }

  /// Makes room for `count` more voxels, so that at() does not allocate for them.
  void reserve_more(std::size_t count) {
    while (2 * (size_ + count + 1) > entries_.size()) grow();
  }

  /// Removes all voxels and keeps the memory.
  void clear() noexcept {
    for (Entry& entry : entries_) entry.key = no_key;
    size_ = 0;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return entries_.capacity() * sizeof(Entry); }

 private:
  // The slot of a key, or the empty slot for it.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    std::uint64_t hash = key * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
    const std::size_t mask = entries_.size() - 1;
    auto slot = static_cast<std::size_t>(hash) & mask;
    while (entries_[slot].key != no_key && entries_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    constexpr std::size_t smallest = 1024;
    std::vector<Entry> larger(entries_.empty() ? smallest : 2 * entries_.size());
    entries_.swap(larger);
    for (const Entry& entry : larger) {
      if (entry.key != no_key) entries_[slot_of(entry.key)] = entry;
    }
  }

  std::vector<Entry> entries_;  // the number of entries is a power of two, or 0
  std::size_t size_ = 0;
};

}  // namespace flagstone

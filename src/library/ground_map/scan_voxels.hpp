// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "library/ground_map/grid_points.hpp"

namespace flagstone {

/// Indices of a voxel in the grid of a scan, see GridPoints. Columns and rows are below 2^16.
class GridVoxel {
 public:
  GridVoxel() = default;
  /// The voxel of a point.
  GridVoxel(const GridPoints& points, std::size_t k) noexcept
      : number_(std::uint64_t{static_cast<std::uint32_t>(points.level[k])} << 32U |
                static_cast<std::uint32_t>(points.row[k]) << 16U |
                static_cast<std::uint32_t>(points.column[k])) {}

  [[nodiscard]] std::uint32_t column() const noexcept { return number_ & 0xFFFFU; }
  [[nodiscard]] std::uint32_t row() const noexcept { return number_ >> 16U & 0xFFFFU; }
  /// Modulo 2^32: it can be negative.
  [[nodiscard]] std::uint32_t level() const noexcept {
    return static_cast<std::uint32_t>(number_ >> 32U);
  }
  /// The upper bits depend on all indices.
  [[nodiscard]] std::uint64_t hash() const noexcept { return number_ * 0x9E3779B97F4A7C15U; }

  friend bool operator==(GridVoxel, GridVoxel) = default;

 private:
  std::uint64_t number_ = 0;  // all indices, so that they are compared at once
};

/// The voxels that one scan measures, each with the number of its points. Reuses its memory.
class ScanVoxels {
 public:
  struct Voxel {
    GridVoxel at{};
    std::uint32_t ground = 0, all = 0;  ///< number of points
  };

  /// Removes all voxels.
  void clear();

  /// Prepares that many calls of count(). May throw std::bad_alloc.
  void reserve(std::size_t points) {
    if (2 * (size_ + points) > slots_.size()) grow(points);
  }

  /// Counts a point and returns the index of its voxel in voxels(). Nearly without branches, which
  /// no CPU could predict: most points of rough ground are in another voxel than the point before.
  std::uint32_t count(GridVoxel at, bool is_ground) noexcept {
    std::uint32_t& slot = slot_of(at);
    const bool is_new = slot == none;
    voxels_[size_] = {.at = at};
    slot = is_new ? size_ : slot;
    size_ += is_new ? 1U : 0U;
    Voxel& voxel = voxels_[slot];
    voxel.ground += is_ground ? 1U : 0U;
    ++voxel.all;
    return slot - 1;
  }

  /// In the order of their first points.
  [[nodiscard]] std::span<const Voxel> voxels() const noexcept {
    return {voxels_.data() + 1, size_ - std::size_t{1}};
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return voxels_.capacity() * sizeof(Voxel) + slots_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t none = 0;

  // The slot of a voxel, or the empty slot for it: linear probing. The voxel that empty slots refer
  // to becomes the searched one, which ends the search.
  std::uint32_t& slot_of(GridVoxel at) noexcept {
    const std::size_t mask = slots_.size() - 1;
    auto slot = static_cast<std::size_t>(at.hash() >> 32U) & mask;
    voxels_[none].at = at;
    while (!(voxels_[slots_[slot]].at == at)) slot = (slot + 1) & mask;
    return slots_[slot];
  }

  void grow(std::size_t points);

  std::vector<Voxel> voxels_ = std::vector<Voxel>(2);  // the first one is of empty slots
  std::uint32_t size_ = 1;                             // used part of them
  std::vector<std::uint32_t> slots_;  // indices of voxels or none; a power of two, or empty
};

}  // namespace flagstone

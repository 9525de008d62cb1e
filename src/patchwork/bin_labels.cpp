// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patchwork/bin_labels.hpp"

#include <algorithm>
#include <cstring>

namespace flagstone::patchwork {
namespace {

template <std::size_t size>
void copy_ends(const std::uint8_t* from, std::size_t count, Label* to) noexcept {
  std::memcpy(to, from, size);
  std::memcpy(to + count - size, from + count - size, size);
}

/// Copies `count` labels. Most runs are short, and memcpy of an unknown size costs more than they.
void copy(const std::uint8_t* from, std::size_t count, Label* to) noexcept {
  if (count >= 16) {
    for (std::size_t i = 0; i + 16 <= count; i += 16) std::memcpy(to + i, from + i, 16);
    std::memcpy(to + count - 16, from + count - 16, 16);
  } else if (count >= 8) {
    copy_ends<8>(from, count, to);
  } else if (count >= 4) {
    copy_ends<4>(from, count, to);
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<Label>(from[i]);
  }
}

}  // namespace

LabelCounts BinLabels::write(const BinBatch& batch, std::size_t i, const GroundSet& set,
                               const BinGroups& groups, std::span<Label> labels) noexcept {
  const LabelCounts counts = label_points(batch, i, set, packed_.data());
  const std::uint8_t* next = packed_.data();
  if (groups.scattered()) {
    for (const std::uint32_t point : groups.points(batch.bin(i))) {
      labels[point] = static_cast<Label>(*next++);
    }
  } else {
    for (const Run& run : groups.runs(batch.bin(i))) {
      copy(next, run.length, labels.data() + run.begin);
      next += run.length;
    }
  }
  return counts;
}

std::uint32_t BinLabels::fill(const BinGroups& groups, std::uint32_t bin, Label label,
                     std::span<Label> labels) noexcept {
  if (groups.scattered()) {
    for (const std::uint32_t point : groups.points(bin)) labels[point] = label;
  } else {
    for (const Run& run : groups.runs(bin)) {
      std::fill_n(labels.data() + run.begin, run.length, label);
    }
  }
  return groups.size(bin);
}

}  // namespace flagstone::patchwork

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/occupied_cells.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/occupied_cells.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"

#ifndef FLAGSTONE_SURFACE_OCCUPIED_CELLS_ONCE
#define FLAGSTONE_SURFACE_OCCUPIED_CELLS_ONCE
namespace flagstone::surface {

/// Cells with fewer points are not observed.
inline constexpr std::uint32_t fewest_points_in_cell = 3;

/// Maximum number of cells of a block.
inline constexpr std::size_t most_cells_of_block = 1024;

/// Where to write cells of one size.
struct ListEnd {
  std::uint32_t *firsts, *counts, *places;
  std::size_t size;
};
using ListEnds = std::array<ListEnd, cell_sizes>;

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using namespace flagstone::HWY_NAMESPACE;  // NOLINT(google-build-using-namespace): its other half

HWY_INLINE IntVector load(const std::uint32_t* from) {
  return hn::LoadU(IntTag(), reinterpret_cast<const std::int32_t*>(from));
}

/// Appends the cells of the mask.
HWY_INLINE void append(IntVector firsts, IntVector counts, IntVector places, hn::Mask<IntTag> mask,
                       ListEnd& to) {
  const auto write = [&](IntVector v, std::uint32_t* column) HWY_ATTR {
    compress_store(v, mask, reinterpret_cast<std::int32_t*>(column + to.size));
  };
  write(firsts, to.firsts);
  write(counts, to.counts);
  write(places, to.places);
  to.size += hn::CountTrue(IntTag(), mask);
}

void list_blocks(std::span<const LevelBlock> blocks, std::span<const std::uint32_t> places,
                 const std::uint32_t* begins, ListEnds& given) {
  const IntTag di;
  ListEnds ends = given;
  std::array<std::uint32_t, most_cells_of_block + 1> copy;
  for (const LevelBlock& block : blocks) {
    const std::uint32_t* cells = begins + block.first_cell;
    const std::size_t count = places.size();
    if (cells[0] == cells[count * block.step]) continue;  // no points
    if (block.step > 1) {
      for (std::size_t i = 0; i <= count; ++i) copy[i] = cells[i * block.step];
      cells = copy.data();
    }
    const IntVector first_place = hn::Set(di, static_cast<std::int32_t>(block.first_place));
    for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
      if (cells[i] == cells[i + hn::Lanes(di)]) continue;
      const IntVector first = load(cells + i);
      const IntVector held = hn::Sub(load(cells + i + 1), first);
      const IntVector place = hn::Add(load(places.data() + i), first_place);
      const auto above = [&](std::uint32_t limit) HWY_ATTR {
        return hn::Gt(held, hn::Set(di, static_cast<std::int32_t>(limit)));
      };
      const auto is_listed = above(fewest_points_in_cell - 1);
      const auto is_not_small = above(small_cell);
      const auto is_large = above(medium_cell);
      append(first, held, place, hn::AndNot(is_not_small, is_listed), ends[0]);
      append(first, held, place, hn::AndNot(is_large, is_not_small), ends[1]);
      append(first, held, place, is_large, ends[2]);
    }
  }
  given = ends;
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(list_blocks);

/// Elements that vectors can write after the last one.
constexpr std::size_t slack = 16;

}  // namespace

void CellLists::reserve(std::size_t cells) {
  for (Columns& columns : columns_) {
    columns.firsts.reserve(cells + slack);
    columns.counts.reserve(cells + slack);
    columns.places.reserve(cells + slack);
  }
}

void CellLists::list(std::span<const LevelBlock> blocks, std::span<const std::uint32_t> places,
                     const std::uint32_t* begins) noexcept {
  ListEnds ends;
  for (std::size_t size = 0; size < cell_sizes; ++size) {
    Columns& columns = columns_[size];
    ends[size] = {.firsts = columns.firsts.data(),
                  .counts = columns.counts.data(),
                  .places = columns.places.data(),
                  .size = 0};
  }
  HWY_DYNAMIC_DISPATCH(list_blocks)(blocks, places, begins, ends);
  for (std::size_t size = 0; size < cell_sizes; ++size) columns_[size].size = ends[size].size;
}

}  // namespace flagstone::surface
#endif

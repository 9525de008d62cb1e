// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/coarse_samples.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "library/surface/coarse_samples.cpp"
#include <hwy/foreach_target.h>
// The above includes this file once for each instruction set.
#include "library/core/simd/lanes-inl.hpp"
#include "library/plane_fits/ground_sets.hpp"
#include "library/surface/content_sample-inl.hpp"

#ifndef FLAGSTONE_SURFACE_COARSE_SAMPLES_ONCE
#define FLAGSTONE_SURFACE_COARSE_SAMPLES_ONCE
namespace flagstone::surface {

/// Maximum and expected number of points of a patch.
inline constexpr std::uint32_t most_of_patch = 128;
inline constexpr std::uint32_t wanted_of_patch = 112;
static_assert(most_of_patch <= plane_fits::ExactGrid::most_points);

/// The points of one coarse cell of a patch.
struct PatchCell {
  std::span<const PackedPoint> points;
  float x, y;  ///< lower corner of the cell, relative to the centre of the patch, metres
};

/// Where to write the points of a patch.
struct PatchPlaces {
  float *x, *y, *z;
};

}  // namespace flagstone::surface
#endif

HWY_BEFORE_NAMESPACE();
namespace flagstone::surface::HWY_NAMESPACE {
namespace {

inline constexpr SampleSize cell_sample{.most = CoarseSamples::most, .wanted = 24};

std::size_t take_cell(const PackedPoint* points, std::size_t count, PackedPoint* sample) {
  return take_sample(points, count, cell_sample, sample);
}

/// Writes one coarse cell, with coordinates on the grid of ExactGrid. May write 16 more elements.
HWY_INLINE void unpack(const PatchCell& cell, const PatchPlaces& to, std::size_t first) {
  const FloatTag d;
  const IntTag di;
  const IntVector byte = hn::Set(di, 0xFF);
  const FloatVector xy_step = hn::Set(d, plane_fits::ExactGrid::xy_step);
  const FloatVector z_step = hn::Set(d, plane_fits::ExactGrid::z_step);
  const auto* const from = reinterpret_cast<const std::int32_t*>(cell.points.data());
  for (std::size_t i = 0; i < cell.points.size(); i += hn::Lanes(d)) {
    const IntVector v = hn::LoadU(di, from + i);
    const IntVector x = hn::And(v, byte);
    const IntVector y = hn::And(hn::ShiftRight<8>(v), byte);
    // Rounds from 1/512 m to 1/256 m.
    const IntVector z = hn::ShiftRight<1>(hn::Add(hn::ShiftRight<16>(v), hn::Set(di, 1)));
    const auto scaled = [&](IntVector whole, FloatVector step, float corner) HWY_ATTR {
      return hn::Add(hn::Mul(hn::ConvertTo(d, whole), step), hn::Set(d, corner));
    };
    hn::StoreU(scaled(x, xy_step, cell.x), d, to.x + first + i);
    hn::StoreU(scaled(y, xy_step, cell.y), d, to.y + first + i);
    hn::StoreU(scaled(z, z_step, 0), d, to.z + first + i);
  }
}

/// Makes the elements after the last point infinitely high.
HWY_INLINE void pad(const PatchPlaces& to, std::size_t size) {
  const FloatTag d;
  for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
    hn::StoreU(hn::Zero(d), d, to.x + size + lane);
    hn::StoreU(hn::Zero(d), d, to.y + size + lane);
    hn::StoreU(hn::Set(d, std::numeric_limits<float>::infinity()), d, to.z + size + lane);
  }
}

void unpack_patch(std::span<const PatchCell> cells, const PatchPlaces& to) {
  std::size_t size = 0;
  for (const PatchCell& cell : cells) {
    unpack(cell, to, size);
    size += cell.points.size();
  }
  pad(to, size);
}

std::int32_t patch_threshold(const PackedPoint* points, std::size_t count) {
  return sample_threshold(points, count, {.most = most_of_patch, .wanted = wanted_of_patch},
                          patch_hash);
}

std::size_t copy_patch_sample(const PackedPoint* points, std::size_t count, std::int32_t threshold,
                              PackedPoint* sample) {
  return copy_sample(points, count, threshold, patch_hash, most_of_patch, sample);
}

}  // namespace
}  // namespace flagstone::surface::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flagstone::surface {
namespace {
HWY_EXPORT(take_cell);
HWY_EXPORT(unpack_patch);
HWY_EXPORT(patch_threshold);
HWY_EXPORT(copy_patch_sample);

/// Elements that vectors can read or write after the last one.
constexpr std::size_t slack = 16;

/// Coarse cells in the largest patch.
constexpr std::size_t most_cells_of_patch = 16;

}  // namespace

CoarseSamples::CoarseSamples(const SquareCells& cells)
    : blocks_(cells.blocks()), packed_zero_(cells.packed_zero()) {
  begins_.reserve(coarse_cells_of_block * blocks_.size() + 1);
}

void CoarseSamples::reserve(std::size_t points) {
  const std::size_t coarse_cells = coarse_cells_of_block * blocks_.size();
  samples_.reserve(std::min(points, coarse_cells * most) + most + 4 * slack);
}

void CoarseSamples::take(const PackedPoints& points) noexcept {
  std::uint32_t* begin = begins_.data();
  std::uint32_t next = 0;
  for (const CellRange& block : blocks_) {
    if (points.points(block.first, block.last).empty()) {
      std::fill_n(begin, coarse_cells_of_block, next);
      begin += coarse_cells_of_block;
      continue;
    }
    const std::uint32_t each = (block.last - block.first) / coarse_cells_of_block;
    for (std::uint32_t i = 0; i < coarse_cells_of_block; ++i) {
      *begin++ = next;
      const std::uint32_t cell = block.first + i * each;
      const std::span<const PackedPoint> all = points.points(cell, cell + each);
      PackedPoint* const to = samples_.data() + next;
      if (all.size() <= most) {
        std::memcpy(to, all.data(), most * sizeof *to);  // of constant length, which is faster
        next += static_cast<std::uint32_t>(all.size());
      } else {
        next +=
            static_cast<std::uint32_t>(HWY_DYNAMIC_DISPATCH(take_cell)(all.data(), all.size(), to));
      }
    }
  }
  *begin = next;
}

void CoarseSamples::add_patch(const SquarePatch& patch,
                              plane_fits::BinBatch& batch) const noexcept {
  std::array<PackedPoint, most_of_patch + slack> sample;
  std::array<PatchCell, most_cells_of_patch> cells;
  const std::size_t cell_count = patch.coarse.last - patch.coarse.first;
  const std::span<const PackedPoint> all = points(patch.coarse.first, patch.coarse.last);
  const bool too_many = all.size() > most_of_patch;
  const std::int32_t threshold =
      too_many ? HWY_DYNAMIC_DISPATCH(patch_threshold)(all.data(), all.size()) : 0;
  std::size_t size = 0;
  for (std::uint32_t i = 0; i < cell_count; ++i) {
    std::span<const PackedPoint> held = points(patch.coarse.first + i, patch.coarse.first + i + 1);
    if (too_many) {
      PackedPoint* const to = sample.data() + size;
      held = {to, HWY_DYNAMIC_DISPATCH(copy_patch_sample)(held.data(), held.size(), threshold, to)};
    }
    const InBlock place = in_z_order[i];  // the first sixteen of the block are a square of 4 x 4
    const auto corner = [&](std::uint8_t index) {
      return static_cast<float>(packed_cell * int{index}) - patch.size / 2;
    };
    cells[i] = {.points = held, .x = corner(place.column), .y = corner(place.row)};
    size += held.size();
  }

  // x and y are rounded down in packed points.
  constexpr float rounding = plane_fits::ExactGrid::xy_step / 2;
  const std::size_t bin = batch.count();
  batch.add_empty(size, {.x = patch.x + rounding, .y = patch.y + rounding, .z = packed_zero_});
  HWY_DYNAMIC_DISPATCH(unpack_patch)
  (std::span(cells.data(), cell_count),
   PatchPlaces{.x = batch.x(bin), .y = batch.y(bin), .z = batch.z(bin)});
}

}  // namespace flagstone::surface
#endif

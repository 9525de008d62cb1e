// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/ground_surface.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/buffer.hpp"
#include "library/core/thread_pool.hpp"
#include "library/surface/cell_observations.hpp"
#include "library/surface/coarse_samples.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/occupied_cells.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// The surface on grids of 2, 1, 0.5 and 0.25 m. Each grid corrects the previous one with the
/// heights of the points above it.
class ResidualPyramid {
 public:
  /// May throw std::bad_alloc.
  ResidualPyramid(const SurfaceConfig& config, const SquareCells& cells);

  /// The grids, coarsest first. Their heights are contiguous in memory, and so are their
  /// confidences. After the heights as many floats as in a row, and 16 more, can be read.
  [[nodiscard]] std::span<const Grid> grids() const noexcept { return grids_; }

  /// Number of cells along one side of the widest grid.
  [[nodiscard]] std::size_t most_cells_along() const noexcept;

  /// Reserves memory for the grids in `surface`; may throw std::bad_alloc.
  void reserve(GroundSurface& surface) const;

  /// Copies the grids into `surface`, with calibrated confidences, after reserve(). Heights with
  /// too little confidence become NaN, in the grids too.
  void finish(GroundSurface& surface) noexcept;

  /// Refines the surface on the coarsest grid, then computes the finer grids from it.
  void refine(const PackedPoints& points, const CoarseSamples& samples, PullPush& pull_push,
              ThreadPool& pool) noexcept;

 private:
  /// The cells of a level.
  struct LevelCells {
    std::vector<LevelBlock> blocks;
    /// By index along the Z-order curve: distance in the grid from the first cell of the block.
    std::vector<std::uint32_t> places;
    const std::int16_t* gates = nullptr;  ///< by cell of the grid
    CellLists lists;
  };

  void list_blocks(const SquareCells& cells);
  [[nodiscard]] float gate_of(std::size_t level) const noexcept;
  void observe_level(std::size_t level, const PackedPoint* points, ThreadPool& pool) noexcept;
  void look_again(const Observations& observations, std::span<const OccupiedCell> cells,
                  std::size_t width, ThreadPool& pool) noexcept;

  Refinement settings_;
  float packed_zero_;  ///< see SquareCells
  std::vector<Grid> grids_;
  std::vector<LevelCells> cells_;  ///< by level
  Buffer<float> heights_;
  Buffer<float> confidences_;
  Buffer<float> corrections_;  ///< of the level in work, 0 between levels
  Buffer<float> weights_;
  Buffer<std::int32_t> slopes_;  ///< of the level in work; see CellPlanes
  Buffer<std::int32_t> offsets_;
  Buffer<std::uint32_t> unclear_counts_;  ///< by job: number of cells that need a second look
  Buffer<OccupiedCell> unclear_;          ///< job by job, then without gaps
  Buffer<Candidate> candidates_;
  Buffer<std::int16_t> gates_;  ///< of all grids
};

}  // namespace flagstone::surface

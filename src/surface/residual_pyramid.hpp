// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/buffer.hpp"
#include "core/crew.hpp"
#include "flagstone/surface_config.hpp"
#include "patches/bin_groups.hpp"
#include "surface/cell_observations.hpp"
#include "surface/grid.hpp"
#include "surface/pull_push.hpp"
#include "surface/square_cells.hpp"

namespace flagstone::surface {

/// The surface on grids of 2, 1, 0.5 and 0.25 m, each correcting the one before by what its points'
/// heights above it say.
class ResidualPyramid {
 public:
  /// May throw std::bad_alloc.
  ResidualPyramid(const SurfaceConfig& config, const SquareCells& cells);

  /// Coarsest first; they lie one after another in memory, heights as well as confidences.
  [[nodiscard]] std::span<const Grid> grids() const noexcept { return grids_; }

  /// Refines the surface on the coarsest grid, and from it makes those on the others.
  void refine(const patches::BinGroups& groups, PullPush& pull_push, Crew& crew) noexcept;

 private:
  /// A cell of a level: its points and its place in the grid.
  struct LevelCell {
    CellRange cells;
    std::uint16_t row, column;
  };
  /// The cells of a level that lie in one block.
  struct LevelBlock {
    CellRange cells;
    std::uint32_t first;  ///< of `level_cells`
    std::uint32_t last;
  };
  struct LevelPlan {
    std::vector<LevelCell> cells;
    std::vector<LevelBlock> blocks;
  };

  void plan_level(std::size_t level, const SquareCells& cells);
  std::span<const OccupiedCell> occupied_cells(const LevelPlan& plan,
                                               const patches::BinGroups& groups) noexcept;
  void refine_level(std::size_t level, const patches::BinGroups& groups, PullPush& pull_push,
                    Crew& crew) noexcept;

  Refinement settings_;
  std::vector<Grid> grids_;
  std::vector<LevelPlan> plans_;
  Buffer<float> heights_;
  Buffer<float> confidences_;
  Buffer<float> corrections_;
  Buffer<float> weights_;
  Buffer<OccupiedCell> occupied_;
};

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace flagstone {

/// The stages of Patchwork::segment and Surface::segment, in order. Bins of `surface` are the cells
/// of its finest grid, and in the stages gather to solve its patches.
enum class Stage : std::uint8_t {
  /// Read each point, find its bin, record runs of points in the same bin (III-B). `surface` also
  /// packs each point into four bytes.
  bin,
  /// Sort the runs by bin, list the patches, label points without a patch. `surface` sorts the
  /// packed points and selects samples, but labels no points.
  group,
  gather,   ///< copy the points of each bin (`surface`: the samples) next to each other
  seed,     ///< compute the mean height of the lowest points, eq. (5)
  moments,  ///< sum over the ground sets, eq. (6)
  solve,    ///< compute planes and evaluate each of them, eqs. (4), (8) to (12)
  join,     ///< select ground patches and merge them into a surface; `surface` only
  refine,   ///< refine the surface level by level; `surface` only
  /// Compute the height of each point above the surface, and its label unless it depends on
  /// obstacles; `surface` only.
  measure,
  label,  ///< write the labels; `surface`: of the points that depend on obstacles, and lower ground
};

/// Number of stages.
inline constexpr std::size_t stage_count = 10;

/// Name of a stage, for example "gather".
constexpr const char* to_string(Stage stage) noexcept {
  switch (stage) {
    case Stage::bin: return "bin";
    case Stage::group: return "group";
    case Stage::gather: return "gather";
    case Stage::seed: return "seed";
    case Stage::moments: return "moments";
    case Stage::solve: return "solve";
    case Stage::join: return "join";
    case Stage::refine: return "refine";
    case Stage::measure: return "measure";
    case Stage::label: return "label";
  }
  return "unknown";
}

/// Seconds spent in each stage, in the order of `Stage`.
using StageTimes = std::array<double, stage_count>;

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace flagstone {

/// What Patchwork::segment does, in order.
enum class Stage : std::uint8_t {
  bin,      ///< read every point, find its bin, note where runs of one bin begin (III-B)
  group,    ///< sort the runs by bin, list the patches, label points without one
  gather,   ///< pack the points of each bin
  seed,     ///< mean height of the lowest points, eq. (5)
  moments,  ///< sums over the ground sets, eq. (6)
  solve,    ///< planes and their likelihood, eqs. (4), (8) to (12)
  join,     ///< which patches are ground, and one surface of them; `surface` alone
  refine,   ///< the residual pyramid; `surface` alone
  measure,  ///< heights of points above the surface; `surface` alone
  label,    ///< write labels
};

/// Number of stages.
inline constexpr std::size_t stage_count = 10;

/// Name of a stage, e.g. "gather".
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

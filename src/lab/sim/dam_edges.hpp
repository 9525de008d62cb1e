// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lab/sim/road_edge.hpp"

namespace flagstone::sim {

/// Measures of a road between a dam's slope and a cutting.
struct DamMeasures {
  double dam = 3;          ///< how much lower the land lies beside the dam, metres
  double run = 1.7;        ///< metres out for a metre down or up
  double drop = 2;         ///< of the retaining wall below the road, metres
  double cut = 3;          ///< how much higher the land lies beside the cutting
  double ditch = 0.8;      ///< depth, metres
  double bottom = 0.8;     ///< width of its flat bottom, metres
  double cut_ditch = 0.5;  ///< depth of the one below the cutting, metres
  bool wet = false;        ///< is there water in the dam's ditch?
};

/// Down the dam: a slope, a slope with a ditch at its foot, a retaining wall. Walls are no ground,
/// though they belong to its surface.
std::vector<EdgeKind> dam_kinds(const DamMeasures& with);

/// Up the cutting, behind a ditch: a slope, a retaining wall.
std::vector<EdgeKind> cutting_kinds(const DamMeasures& with);

}  // namespace flagstone::sim

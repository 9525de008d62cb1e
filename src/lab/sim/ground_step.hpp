// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace flagstone::sim {

/// A straight, sharp change of the ground's height that runs along the x axis of the world, of the
/// same shape from one end to the other. Metres.
struct GroundStep {
  std::string_view kind;          ///< as tables call it
  double x_begin = 0, x_end = 0;  ///< along the step
  double y_begin = 0, y_end = 0;  ///< across it: from the edge nearer to the path to the other
  double rise = 0;                ///< from y_begin to y_end, below 0 for a drop
};

}  // namespace flagstone::sim

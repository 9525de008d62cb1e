// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone::sim {

/// From where to where something is drawn or stands.
struct Interval {
  double low = 0, high = 0;
};

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/sweep_axis.hpp"
#include "lab/eval/results.hpp"

namespace flagstone::cli {

/// A sweep: one method evaluated at every point of a grid.
struct Sweep {
  std::string method;
  std::vector<SweepAxis> axes;  ///< one or two; the last one's values change fastest
  eval::Results results;        ///< a "method" per point, in that order

  /// The values at a point, one per axis.
  [[nodiscard]] std::vector<std::string> values_at(std::size_t point) const;
};

/// A row per point: its values, then precision, recall and F1 with their scatter.
std::string to_text(const Sweep& sweep);
std::string to_csv(const Sweep& sweep);
nlohmann::ordered_json to_json(const Sweep& sweep);

/// Which point has the highest mean F1, and how far ahead of the next it is: in points and as a
/// multiple of the half width of the 95 % interval of their difference, scan by scan.
std::string winner_text(const Sweep& sweep);

}  // namespace flagstone::cli

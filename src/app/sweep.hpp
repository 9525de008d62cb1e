// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "lab/eval/method.hpp"
#include "lab/eval/results.hpp"

namespace flagstone::app {

/// A setting and the values it takes in a sweep.
struct SweepAxis {
  std::string key;  ///< a setting of the method, or "bins"
  std::vector<std::string> values;
};

/// An axis from "KEY=VALUE,VALUE,...". Throws std::invalid_argument.
SweepAxis sweep_axis(const std::string& text);

/// One or two axes; without any, those of the paper's Fig. 5: bin sizes of the uniform grid and
/// uprightness thresholds. Throws std::invalid_argument.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts);

/// Gives a setting one of its values. The key `bins`, for Patchwork and its relatives, makes the
/// uniform polar grid N_r x N_theta of "30x108": one zone of equal rings from min_range to where
/// the last zone ends. Throws std::invalid_argument.
void apply_axis(const std::string& key, const std::string& value, MethodConfig& config);

/// A sweep: one method evaluated at every point of a grid.
struct Sweep {
  std::string method;
  std::vector<SweepAxis> axes;  ///< one or two; the last one's values change fastest
  eval::Results results{};      ///< a "method" per point, in that order

  /// The values at a point, one per axis.
  [[nodiscard]] std::vector<std::string> values_at(std::size_t point) const;

  /// The method with the settings of each point, which start from `base`. Throws
  /// std::invalid_argument.
  [[nodiscard]] std::vector<eval::Method> points(const MethodConfig& base,
                                                 const MountSettings& mount) const;
};

/// A row per point: its values, then precision, recall and F1 with their standard deviations.
std::string to_text(const Sweep& sweep);
std::string to_csv(const Sweep& sweep);
nlohmann::ordered_json to_json(const Sweep& sweep);

/// Which point has the highest mean F1, and how far ahead of the next it is: in percentage points
/// and as a multiple of the half width of the 95 % interval of their difference, paired by scan.
std::string winner_text(const Sweep& sweep);

}  // namespace flagstone::app

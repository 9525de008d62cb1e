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

/// A setting and its values in a sweep.
struct SweepAxis {
  std::string key;  ///< a setting of the method, or "bins"
  std::vector<std::string> values;
};

/// Parses "KEY=VALUE,VALUE,...". Throws std::invalid_argument.
SweepAxis sweep_axis(const std::string& text);

/// Parses one or two axes. Without any, returns those of Fig. 5 of the Patchwork paper: bin sizes
/// of the uniform grid and uprightness thresholds. Throws std::invalid_argument.
std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts);

/// Sets a setting to one of its values. The key `bins` (patchwork, r_gpf and czm+... only) with the
/// value "30x108" sets a uniform polar grid N_r x N_theta: one zone with rings of equal width from
/// min_range to the end of the last zone. Throws std::invalid_argument.
void apply_axis(const std::string& key, const std::string& value, MethodConfig& config);

/// A sweep: one method evaluated at every point of a grid.
struct Sweep {
  std::string method;
  std::vector<SweepAxis> axes;  ///< one or two; values of the last axis change fastest
  eval::Results results{};      ///< one "method" per point, in this order

  /// The values at a point, one per axis.
  [[nodiscard]] std::vector<std::string> values_at(std::size_t point) const;

  /// One method per point: `base` with the values of the point. Throws std::invalid_argument.
  [[nodiscard]] std::vector<eval::Method> points(const MethodConfig& base,
                                                 const MountSettings& mount) const;
};

/// One row per point: its values, then precision, recall and F1 with their standard deviations.
std::string to_text(const Sweep& sweep);
std::string to_csv(const Sweep& sweep);
nlohmann::ordered_json to_json(const Sweep& sweep);

/// The point with the highest mean F1, and its lead over the next one: in percentage points, and as
/// a multiple of the half-width of the 95 % confidence interval of the difference, paired by scan.
std::string winner_text(const Sweep& sweep);

}  // namespace flagstone::app

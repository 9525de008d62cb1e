// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "flagstone/make_segmenter.hpp"

namespace flagstone::cli {

/// A setting and the values it takes in a sweep.
struct SweepAxis {
  std::string key;  ///< a setting of the method, or "bins"
  std::vector<std::string> values;
};

/// An axis from "KEY=VALUE,VALUE,...". Throws std::invalid_argument.
SweepAxis sweep_axis(const std::string& text);

/// Gives a setting one of its values. The key `bins`, for Patchwork and its relatives, makes the
/// uniform polar grid N_r x N_theta of "30x108": one zone of equal rings from min_range to where
/// the last zone ends. Throws std::invalid_argument.
void apply_axis(const std::string& key, const std::string& value, MethodConfig& config);

}  // namespace flagstone::cli

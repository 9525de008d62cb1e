// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"

namespace flagstone::app {

/// Describes a scan in text: number of points, fields with their bounds, histograms of range and
/// height.
std::string info_text(const std::string& file, const io::Cloud& cloud);

/// A histogram as text, one line per bin: its bounds, a bar, its percentage. `edges` must ascend.
/// Bin i contains edges[i] <= value < edges[i + 1]; the last bin includes its upper edge. Values
/// outside are counted on a separate line. Values must not be NaN.
std::string histogram_text(std::span<const float> values, std::span<const float> edges);

/// Edges of about `count` bins of a round width. They contain all values except the outermost
/// thousandth on each side. Returns at least two edges.
std::vector<float> round_edges(std::span<const float> values, std::size_t count);

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"

namespace flagstone::app {

/// What a scan contains, for people: number of points, fields with their bounds, histograms of
/// range and height.
std::string info_text(const std::string& file, const io::Cloud& cloud);

/// A histogram as text, one line per class of values, for a terminal: its bounds, a bar, its share.
/// `edges` ascend; class i holds edges[i] <= value < edges[i + 1], the last one its upper edge too.
/// Values outside are counted in a line of their own. Values must not be NaN.
std::string histogram_text(std::span<const float> values, std::span<const float> edges);

/// About `count` classes of a round width that hold all but the outermost thousandth of the values
/// on either side; at least two edges.
std::vector<float> round_edges(std::span<const float> values, std::size_t count);

}  // namespace flagstone::app

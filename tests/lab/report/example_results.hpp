// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace flagstone::report {

/// Synthetic results of an evaluation of `methods` methods on `scans` scans.
nlohmann::ordered_json example_eval(std::size_t methods, std::size_t scans);

/// Synthetic results of a sweep over `first` grid sizes and `second` thresholds; with 0 thresholds,
/// a sweep of one key. Grid sizes are strings such as "10x36", unless `numeric`.
nlohmann::ordered_json example_sweep(std::size_t first, std::size_t second, bool numeric = false);

/// An image of one pixel, as PNG.
std::vector<std::byte> one_pixel_png();

}  // namespace flagstone::report

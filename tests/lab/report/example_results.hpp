// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace flagstone::report {

/// Made-up results of an evaluation of `methods` methods on `scans` scans.
nlohmann::ordered_json example_eval(std::size_t methods, std::size_t scans);

/// Made-up results of a sweep over `first` grid sizes and `second` thresholds; 0 thresholds: a
/// sweep of one key. Grid sizes are texts, "10x36", unless `numeric`.
nlohmann::ordered_json example_sweep(std::size_t first, std::size_t second, bool numeric = false);

/// A picture of one pixel.
std::vector<std::byte> one_pixel_png();

}  // namespace flagstone::report

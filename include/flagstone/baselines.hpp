// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/gpf.hpp"
#include "flagstone/baselines/line_fit.hpp"
#include "flagstone/baselines/r_gpf.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "flagstone/make_segmenter.hpp"

/// The methods that Patchwork is compared with. Link the CMake target flagstone::baselines.
namespace flagstone {

/// Registers the baselines and the rows of the paper's ablation, so that `method_names()` and
/// `make_segmenter()` include them. Further calls do nothing. Not thread-safe: call it before other
/// threads use methods by name.
void register_baselines();

/// Names of the methods in the paper's Table I, in its order.
std::span<const std::string_view> table_1_methods() noexcept;

}  // namespace flagstone

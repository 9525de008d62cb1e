// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/gpf.hpp"
#include "flagstone/baselines/line_fit.hpp"
#include "flagstone/baselines/r_gpf.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "flagstone/make_segmenter.hpp"

/// What Patchwork is compared with; the target is flagstone::baselines.
namespace flagstone {

/// Makes the baselines and the rows of the paper's ablation known to `method_names()` and
/// `make_segmenter()`. Further calls do nothing. Call it before other threads use methods by name.
void register_baselines();

/// The methods of the paper's Table I, in its order: those that register_baselines() adds.
std::span<const std::string_view> table_1_methods() noexcept;

}  // namespace flagstone

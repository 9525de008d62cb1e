// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "files/render/canvas.hpp"
#include "flagstone/patch.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/status.hpp"

namespace flagstone::render {

/// Name of a verdict in the legend, and the colour its bins are filled with.
struct VerdictLook {
  Verdict verdict;
  const char* name;
  Color color;
};

/// All verdicts on bins of zones in the legend's order: those that `surface` alone gives are not
/// among them.
std::span<const VerdictLook> verdict_looks() noexcept;

/// How much of what lies below a tinted bin its colour covers, 0 to 1.
inline constexpr double tint_opacity = 0.42;

/// Whether every patch is a bin of these zones: `invalid_argument` with the first that is not.
Status check_bins(std::span<const Patch> patches, const PatchworkConfig& config);

/// Fills the bins of the patches, which check_bins has passed, by verdict.
void tint_bins(const Canvas& canvas, const TopView& view, std::span<const Patch> patches,
               const PatchworkConfig& config) noexcept;

/// Draws the edges of all bins; those between zones stand out.
void draw_zone_lines(const Canvas& canvas, const TopView& view, const PatchworkConfig& config,
                     double unit) noexcept;

}  // namespace flagstone::render

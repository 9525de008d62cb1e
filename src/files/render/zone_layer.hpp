// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "files/render/canvas.hpp"
#include "flagstone/patch.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/status.hpp"

namespace flagstone::render {

/// Name of a patch status in the legend, and the colour of its bins.
struct VerdictLook {
  Verdict verdict;
  const char* name;
  Color color;
};

/// Every status that a bin of zones can have, in the order of the legend. Statuses that only
/// `surface` uses are not included.
std::span<const VerdictLook> verdict_looks() noexcept;

/// Opacity of the colour of a tinted bin, 0 to 1.
inline constexpr double tint_opacity = 0.42;

/// Checks that every patch is a bin of these zones: `invalid_argument` with the first that is not.
Status check_bins(std::span<const Patch> patches, const PatchworkConfig& config);

/// Fills the bins of the patches with the colours of their status. check_bins() must have accepted
/// the patches.
void tint_bins(const Canvas& canvas, const TopView& view, std::span<const Patch> patches,
               const PatchworkConfig& config) noexcept;

/// Draws the edges of all bins; edges between zones are emphasized.
void draw_zone_lines(const Canvas& canvas, const TopView& view, const PatchworkConfig& config,
                     double unit) noexcept;

}  // namespace flagstone::render

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/status.hpp"
#include "library/core/truth.hpp"

namespace flagstone::render {

/// What goes into a bird's-eye picture besides the points.
struct BirdsEye {
  /// First and second line above the picture, UTF-8; what does not fit is cut out of the middle.
  std::string title;
  std::string subtitle;

  /// Draws the zones, rings and sectors of the configuration the scan was segmented with, if given;
  /// else circles at round distances.
  const PatchworkConfig* zones = nullptr;

  /// Fills each bin of result.patches() with the colour of its verdict. Needs `zones`.
  bool tint_patches = false;

  /// One entry per point: colours tell right from wrong instead of the label. Empty for none.
  /// As in the evaluation protocols, whatever is not labelled ground counts as not ground.
  std::span<const Truth> reference;

  /// Half of the picture's shorter side, metres, 1 to 1,000. 0 takes the radius that holds 98 % of
  /// the points, rounded up to 10 m, and at most the last ring's where `zones` are given.
  float range = 0;

  /// Pixels, each 320 to 8,192.
  int width = 1600;
  int height = 1780;
};

/// Draws the scan from above and writes it as a PNG file: x, forward, points up and y, left, points
/// left. Points of label `invalid` cannot be drawn and are only counted; nor are points beyond the
/// frame. `result` is what segmenting `cloud` gave. The same input gives the same bytes on the same
/// machine; fonts are the system's.
///
/// Fails with `invalid_argument` for options or zones out of range and for labels, patches or a
/// reference that do not belong to the cloud; with `unwritable` where the file cannot be written,
/// and then nothing is left behind; with `out_of_memory`.
[[nodiscard]] Status draw_birds_eye(const std::filesystem::path& png, CloudView cloud,
                                    const Segmentation& result, const BirdsEye& options) noexcept;

}  // namespace flagstone::render

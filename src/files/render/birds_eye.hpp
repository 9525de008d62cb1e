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

/// Options of a bird's-eye view image.
struct BirdsEye {
  /// First and second line above the view, UTF-8; a text that is too long is cut in its middle.
  std::string title;
  std::string subtitle;

  /// The configuration that the scan was segmented with: its zones, rings and sectors are drawn.
  /// Null: circles at round distances.
  const PatchworkConfig* zones = nullptr;

  /// Fills each bin of result.patches() with the colour of its status. Requires `zones`.
  bool tint_patches = false;

  /// Ground truth, one entry per point: colours then show correct and wrong labels instead of the
  /// labels. May be empty. As in the evaluation protocols, every label except ground counts as
  /// non-ground.
  std::span<const Truth> reference;

  /// Half of the shorter side of the view, metres, 1 to 1,000. 0: the radius that contains 98 % of
  /// the points, rounded up to 10 m, and at most the last ring of `zones` if given.
  float range = 0;

  /// Pixels, each 320 to 8,192.
  int width = 1600;
  int height = 1780;
};

/// Draws a bird's-eye view of the scan as a PNG file: x (forward) points up, y (left) points left.
/// `result` is the result of segmenting `cloud`. Points labelled `invalid` and points outside the
/// view are counted but not drawn. Output is deterministic on one machine; fonts come from the
/// system.
///
/// `invalid_argument` if options or zones are out of range, or if labels, patches or a reference do
/// not belong to the cloud; `unwritable` if the file cannot be written, which leaves no file
/// behind; `out_of_memory`.
[[nodiscard]] Status draw_birds_eye(const std::filesystem::path& png, CloudView cloud,
                                    const Segmentation& result, const BirdsEye& options) noexcept;

}  // namespace flagstone::render

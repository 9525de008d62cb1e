// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/status.hpp"
#include "library/core/truth.hpp"

namespace flagstone::render {

/// The result of one method.
struct Panel {
  std::string title;              ///< below the panel, bold: the name of the method
  std::string subtitle;           ///< below the title, for example precision, recall and F1
  std::span<const Label> labels;  ///< one per point
};

/// Options of an image that compares methods. Texts are UTF-8; a text that is too long is cut in
/// its middle.
struct SideBySide {
  std::string title;
  std::string subtitle;

  /// Half of the side of each panel, metres, 1 to 1,000. 0: the radius that contains 98 % of the
  /// points, rounded up to 10 m.
  float range = 0;

  /// Pixels, 640 to 8,192. The height depends on the number of panels.
  int width = 1800;
};

/// Draws bird's-eye views of one scan as labelled by several methods, in colours that show correct
/// and wrong labels (the paper's Fig. 7). There are up to three panels per row, each with the
/// sensor in the middle; x (forward) points up, y (left) points left. `truth` is the ground truth,
/// one entry per point. `png` receives the bytes of a PNG file and changes only on success. Output
/// is deterministic on one machine; fonts come from the system.
///
/// `invalid_argument` if options are out of range, if there are no panels or more than 30, or if
/// labels or ground truth do not belong to the cloud; `out_of_memory`.
[[nodiscard]] Status render_side_by_side(CloudView cloud, std::span<const Truth> truth,
                                         std::span<const Panel> panels, const SideBySide& options,
                                         std::vector<std::byte>& png) noexcept;

}  // namespace flagstone::render

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

/// What one method made of the scan.
struct Panel {
  std::string title;              ///< below the panel, bold: the method's name
  std::string subtitle;           ///< below that, for example its precision, recall and F1
  std::span<const Label> labels;  ///< one per point
};

/// What goes into a picture of several methods besides the points. Texts are UTF-8; what does not
/// fit is cut out of the middle.
struct SideBySide {
  std::string title;
  std::string subtitle;

  /// Half of each panel's side, metres, 1 to 1,000. 0 takes the radius that holds 98 % of the
  /// points, rounded up to 10 m.
  float range = 0;

  /// Pixels, 640 to 8,192. The height follows from the number of panels.
  int width = 1800;
};

/// Draws one scan from above as several methods labelled it, in the colours that tell right from
/// wrong (the paper's Fig. 7): up to three panels in a row, each with the sensor in its middle, x,
/// forward, up and y, left, to the left. `truth` holds one entry per point. Gives the bytes of a
/// PNG file in `png`, which is only changed on success. The same input gives the same bytes on the
/// same machine; fonts are the system's.
///
/// Fails with `invalid_argument` for options out of range, for none or more than 30 panels, and for
/// labels or a truth that do not belong to the cloud; with `out_of_memory`.
[[nodiscard]] Status render_side_by_side(CloudView cloud, std::span<const Truth> truth,
                                         std::span<const Panel> panels, const SideBySide& options,
                                         std::vector<std::byte>& png) noexcept;

}  // namespace flagstone::render

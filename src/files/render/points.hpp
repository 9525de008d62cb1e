// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/render/canvas.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patch.hpp"
#include "library/core/truth.hpp"

namespace flagstone::render {

/// Points that look alike in the picture and share an entry of the legend.
struct PointKind {
  const char* name;
  Color color;
  double size;  ///< diameter relative to that of ordinary points
  bool drawn;   ///< false: only counted
  std::size_t count = 0;
};

/// Which kind each point of a scan is.
struct PointKinds {
  /// In of_point: a point of label invalid, which has a kind and is counted, but has no place.
  static constexpr std::uint8_t nowhere = 255;

  std::vector<PointKind> kinds;             ///< in the legend's order
  std::vector<std::uint8_t> drawing_order;  ///< indices into kinds; what comes later lies on top
  std::vector<std::uint8_t> of_point;       ///< index into kinds, or nowhere; one per point
};

/// Kinds by label.
PointKinds kinds_by_label(std::span<const Label> labels);

/// Kinds by comparing label and reference, which has an entry per label.
PointKinds kinds_by_truth(std::span<const Label> labels, std::span<const Truth> reference);

/// Draws the points as small discs straight into the canvas's pixels, kind after kind, cut off at
/// the panel's edges. `unit` is the size of a pixel of the default picture. Returns how many points
/// to be drawn lie beyond the panel (also: are not finite).
std::size_t draw_points(const Canvas& canvas, const TopView& view, CloudView cloud,
                        const PointKinds& points, double unit);

/// Writes a row of colours, names, counts and shares of the points and, where the patches are
/// tinted, a second one of their verdicts.
void draw_legend(const Canvas& canvas, const Layout& layout, const PointKinds& points,
                 std::span<const Patch> patches, bool tinted);

/// Writes a row of colours and names alone into `legend`, and `note` below.
void draw_kind_names(const Canvas& canvas, const Rectangle& legend, double unit,
                     const PointKinds& points, const std::string& note);

/// Writes at the panel's lower edge how many points do not show, if any.
void draw_beyond_note(const Canvas& canvas, const Layout& layout, std::size_t beyond);

}  // namespace flagstone::render

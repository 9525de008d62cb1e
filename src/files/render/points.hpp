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

/// Points that look alike in the image and share an entry of the legend.
struct PointKind {
  const char* name;
  Color color;
  double size;  ///< diameter relative to ordinary points
  bool drawn;   ///< false: counted only
  std::size_t count = 0;
};

/// The kind of each point of a scan.
struct PointKinds {
  /// In of_point: a point labelled invalid. It is counted in its kind, but has no position.
  static constexpr std::uint8_t nowhere = 255;

  std::vector<PointKind> kinds;             ///< in the order of the legend
  std::vector<std::uint8_t> drawing_order;  ///< indices into kinds; later kinds are drawn on top
  std::vector<std::uint8_t> of_point;       ///< index into kinds, or nowhere; one per point
};

/// Kinds by label.
PointKinds kinds_by_label(std::span<const Label> labels);

/// Kinds by comparing labels with the reference, which has one entry per label.
PointKinds kinds_by_truth(std::span<const Label> labels, std::span<const Truth> reference);

/// Draws the points as small discs into the pixels of the canvas, one kind after another, clipped
/// at the edges of the panel. `unit` is the size of a pixel of the default image size. Returns the
/// number of points outside the panel, including points that are not finite.
std::size_t draw_points(const Canvas& canvas, const TopView& view, CloudView cloud,
                        const PointKinds& points, double unit);

/// Draws a row of colours, names, counts and percentages of the points and, if the patches are
/// tinted, a second row for the status of the patches.
void draw_legend(const Canvas& canvas, const Layout& layout, const PointKinds& points,
                 std::span<const Patch> patches, bool tinted);

/// Draws a row of colours and names only into `legend`, and `note` below it.
void draw_kind_names(const Canvas& canvas, const Rectangle& legend, double unit,
                     const PointKinds& points, const std::string& note);

/// Writes the number of points outside the view at the lower edge of the panel, if there are any.
void draw_beyond_note(const Canvas& canvas, const Layout& layout, std::size_t beyond);

}  // namespace flagstone::render

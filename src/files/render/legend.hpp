// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "files/render/canvas.hpp"
#include "files/render/layout.hpp"
#include "files/render/point_kinds.hpp"
#include "flagstone/patch.hpp"

namespace flagstone::render {

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

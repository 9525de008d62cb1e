// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "files/render/palette.hpp"
#include "flagstone/label.hpp"
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

}  // namespace flagstone::render

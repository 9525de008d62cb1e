// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "flagstone/label.hpp"
#include "library/core/truth.hpp"

namespace flagstone::eval {

/// How labels compare with the truth; section IV-B of the paper. In points, or in cells of the
/// ground where each counts once. A share whose denominator is zero is 1: nothing was asked for and
/// nothing was missed.
struct Confusion {
  double true_positives = 0;
  double false_positives = 0;
  double false_negatives = 0;
  double true_negatives = 0;

  Confusion& operator+=(const Confusion& other) noexcept;

  /// All that was scored.
  [[nodiscard]] double total() const noexcept {
    return true_positives + false_positives + false_negatives + true_negatives;
  }

  [[nodiscard]] double precision() const noexcept {
    return share(true_positives, true_positives + false_positives);
  }
  [[nodiscard]] double recall() const noexcept {
    return share(true_positives, true_positives + false_negatives);
  }
  [[nodiscard]] double f1() const noexcept {
    return share(2 * true_positives, 2 * true_positives + false_positives + false_negatives);
  }
  [[nodiscard]] double accuracy() const noexcept {
    return share(true_positives + true_negatives, total());
  }
  /// Intersection over union of found and true ground.
  [[nodiscard]] double iou() const noexcept {
    return share(true_positives, true_positives + false_positives + false_negatives);
  }

 private:
  static double share(double part, double whole) noexcept { return whole == 0 ? 1 : part / whole; }
};

/// Compares labels with the truth, one of each per point. Whatever is not labelled ground counts as
/// not ground; ignored points are left out.
Confusion compare(std::span<const Label> labels, std::span<const Truth> truth);

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/truth.hpp"
#include "flagstone/label.hpp"

namespace flagstone::eval {

/// How labels compare with the truth, in points; section IV-B of the paper. A share whose
/// denominator is zero is 1: nothing was asked for and nothing was missed.
struct Confusion {
  std::size_t true_positives = 0;
  std::size_t false_positives = 0;
  std::size_t false_negatives = 0;
  std::size_t true_negatives = 0;

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
    return share(true_positives + true_negatives,
                 true_positives + true_negatives + false_positives + false_negatives);
  }

 private:
  static double share(std::size_t part, std::size_t whole) noexcept {
    return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
  }
};

/// Compares labels with the truth, one of each per point. Whatever is not labelled ground counts as
/// not ground; ignored points are left out.
Confusion compare(std::span<const Label> labels, std::span<const Truth> truth);

}  // namespace flagstone::eval

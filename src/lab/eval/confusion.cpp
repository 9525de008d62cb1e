// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/confusion.hpp"

#include <cstddef>

namespace flagstone::eval {

Confusion& Confusion::operator+=(const Confusion& other) noexcept {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  true_negatives += other.true_negatives;
  return *this;
}

Confusion compare(std::span<const Label> labels, std::span<const Truth> truth) {
  Confusion confusion;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (truth[i] == Truth::ignored) continue;
    const bool found = labels[i] == Label::ground;
    const bool is = truth[i] == Truth::ground;
    confusion.true_positives += found && is;
    confusion.false_positives += found && !is;
    confusion.false_negatives += !found && is;
    confusion.true_negatives += !found && !is;
  }
  return confusion;
}

}  // namespace flagstone::eval

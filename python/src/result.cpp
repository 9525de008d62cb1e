// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "result.hpp"

#include <algorithm>
#include <limits>

namespace flagstone::python {

std::span<const std::uint8_t> Result::ground() {
  const std::span<const Label> labels = segmentation_->labels();
  if (ground_.size() != labels.size()) {
    ground_.resize(labels.size());
    std::ranges::transform(labels, ground_.begin(), [](Label label) {
      return static_cast<std::uint8_t>(label == Label::ground);
    });
  }
  return ground_;
}

std::span<const float> Result::heights() {
  const std::size_t points = segmentation_->labels().size();
  if (segmentation_->heights().size() == points) return segmentation_->heights();
  unknown_heights_.resize(points, std::numeric_limits<float>::quiet_NaN());
  return unknown_heights_;
}

}  // namespace flagstone::python

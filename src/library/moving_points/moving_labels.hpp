// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "flagstone/label.hpp"
#include "flagstone/moving_points.hpp"

namespace flagstone {

/// Sets the labels of all moving points of a scan. `labels`: of its points, as many as the mask
/// has.
void label_moving_points(const MovingMask& moving, Label label, std::span<Label> labels) noexcept;

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "library/surface/packed_points.hpp"

namespace flagstone::surface {

/// Copies one of each group of equal points to `to` and returns their number. Which points these
/// are does not depend on the order of `points`; their order does.
///
/// Reorders `points`. 16 elements after them must be readable. `scratch` has as many elements as
/// there are points; `to` may be the same memory or begin before it.
std::size_t copy_distinct(std::span<PackedPoint> points, PackedPoint* scratch,
                          PackedPoint* to) noexcept;

}  // namespace flagstone::surface

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "library/core/random.hpp"

namespace flagstone::performance {

using Cloud = std::vector<Point>;

inline CloudView view_of(const Cloud& cloud) { return CloudView(std::span<const Point>(cloud)); }

/// A street as a spinning sensor 1.73 m above it sees it, beam by beam: `beams` of them from +2 to
/// -24.8 degrees, `columns` firings a turn, of which two thirds come back.
Cloud simulated_street(int beams, int columns, std::uint64_t seed);

/// `count` points, evenly picked in their order; where there are fewer, as often as it takes, each
/// time turned about z.
Cloud resized(const Cloud& cloud, std::size_t count);

/// The same turned about z by `angle`, radians.
Cloud turned(Cloud cloud, double angle);

/// The same in random order.
Cloud shuffled(Cloud cloud, Random& random);

}  // namespace flagstone::performance

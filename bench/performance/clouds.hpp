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

/// A simulated scan of a street by a spinning sensor at 1.73 m: `beams` beams from +2 to -24.8
/// degrees with `columns` firings per turn, one beam after another. About two thirds of the firings
/// return.
Cloud simulated_street(int beams, int columns, std::uint64_t seed);

/// `count` points, selected evenly and in order. If the cloud has fewer points, copies of it
/// rotated about z are appended.
Cloud resized(const Cloud& cloud, std::size_t count);

/// The cloud rotated about z by `angle` radians.
Cloud rotated(Cloud cloud, double angle);

/// The points in random order.
Cloud shuffled(Cloud cloud, Random& random);

}  // namespace flagstone::performance

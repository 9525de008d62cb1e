// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Functions of src/library/surface/*-inl.hpp, which work on vectors, for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::tests {

/// Number of points per vector.
std::size_t vector_length();

/// A point as CellLocator sees it.
struct Located {
  std::uint32_t cell;           ///< or none()
  surface::PackedPoint packed;  ///< unspecified for none()
};

/// The cell of each point of a cloud, and the point in packed form.
std::vector<Located> located(const std::vector<Point>& cloud, const surface::SquareCells& cells);

/// The cell of each point of a cloud, or none().
std::vector<std::uint32_t> cells_of(const std::vector<Point>& cloud,
                                    const surface::SquareCells& cells);

/// Size of a sample: the maximum and, if there are more points, the expected number of points.
struct SizeOfSample {
  std::uint32_t most, wanted;
};

/// The sample that take_sample() selects.
std::vector<surface::PackedPoint> sample_of(std::vector<surface::PackedPoint> points,
                                            SizeOfSample size);

/// The sample of a patch, by sample_threshold() and copy_sample().
std::vector<surface::PackedPoint> patch_sample_of(std::vector<surface::PackedPoint> points,
                                                  SizeOfSample size);

}  // namespace flagstone::tests

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/cloud_view.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// Reads chunk `chunk` of the cloud, which is no larger than reserved; its bins are square cells.
void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan) noexcept;

}  // namespace flagstone::surface

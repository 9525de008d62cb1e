// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/cloud_view.hpp"
#include "library/patchwork/concentric_zones.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::patchwork {

/// Reads chunk `chunk` of the cloud into `scan`, which is reserved for it, each point in its bin of
/// the Concentric Zone Model, noise(), out_of_range() or invalid(). Chunks may be read by several
/// threads at once.
void read_chunk(CloudView cloud, std::size_t chunk, const ConcentricZones& zones,
                plane_fits::ScanPoints& scan) noexcept;

}  // namespace flagstone::patchwork

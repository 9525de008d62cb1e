// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/patchwork_config.hpp"
#include "library/plane_fits/plane_fit.hpp"

namespace flagstone::patchwork {

/// Section III-C as configured.
plane_fits::FitSettings fit_settings(const PatchworkConfig& config) noexcept;

/// M_h * h_s of each zone: no seed of its bins lies below, metres.
std::vector<double> seed_floors(const PatchworkConfig& config);

}  // namespace flagstone::patchwork

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/patchwork_config.hpp"

namespace flagstone {

/// R-GPF, what Patchwork grew from, as a configuration of it: a uniform polar grid of 3,240 bins is
/// one zone, every bin that a plane is fitted to is ground, and nothing judges it.
///
/// H. Lim, S. Hwang, H. Myung, "ERASOR: Egocentric Ratio of Pseudo Occupancy-Based Dynamic Object
/// Removal for Static 3D Point Cloud Map Building", IEEE RA-L 6(2), 2021. The number of bins is
/// that of section III-B of the Patchwork paper; sectors, L_max and the fit's numbers are ERASOR's
/// published settings for SemanticKITTI.
PatchworkConfig r_gpf_config();

}  // namespace flagstone

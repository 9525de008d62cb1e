// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/patchwork_config.hpp"

namespace flagstone {

/// R-GPF, what Patchwork grew from, as a configuration of it: a uniform polar grid of 3,240 bins is
/// one zone, every bin that a plane is fitted to is ground, and nothing judges it.
///
/// H. Lim, S. Hwang, H. Myung, "ERASOR: Egocentric Ratio of Pseudo Occupancy-Based Dynamic Object
/// Removal for Static 3D Point Cloud Map Building", IEEE RA-L 6(2), 2021. 30 rings of 108 sectors
/// are the 3,240 bins that section III-B of the Patchwork paper counts. Sectors, L_max and the
/// numbers of the fit are those of ERASOR's settings for SemanticKITTI 00 (config/seq_00.yaml; it
/// has 20 rings). ERASOR passes over some lowest points of a bin before it takes seeds; here all
/// count.
PatchworkConfig r_gpf_config();

}  // namespace flagstone

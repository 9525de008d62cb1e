// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/patchwork_config.hpp"

namespace flagstone {

/// R-GPF, the predecessor of Patchwork, as a configuration of Patchwork: one zone with a uniform
/// polar grid of 3,240 bins, in which every bin with a plane is ground.
///
/// H. Lim, S. Hwang, H. Myung, "ERASOR: Egocentric Ratio of Pseudo Occupancy-Based Dynamic Object
/// Removal for Static 3D Point Cloud Map Building", IEEE RA-L 6(2), 2021. 30 rings of 108 sectors
/// are the 3,240 bins in section III-B of the Patchwork paper. The number of sectors, L_max and
/// the parameters of the fit are those of ERASOR's settings for SemanticKITTI 00
/// (config/seq_00.yaml), which have 20 rings. ERASOR skips some of the lowest points of a bin
/// before it selects seeds; this configuration uses all points.
PatchworkConfig r_gpf_config();

}  // namespace flagstone

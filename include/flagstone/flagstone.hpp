// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

/// Includes the whole public API except make_segmenter.hpp and the baselines.

#include "flagstone/cloud_view.hpp"                 // IWYU pragma: export
#include "flagstone/gravity_aligned_segmenter.hpp"  // IWYU pragma: export
#include "flagstone/ground_map.hpp"                 // IWYU pragma: export
#include "flagstone/ground_surface.hpp"             // IWYU pragma: export
#include "flagstone/label.hpp"                      // IWYU pragma: export
#include "flagstone/label_vote.hpp"                 // IWYU pragma: export
#include "flagstone/mount.hpp"                      // IWYU pragma: export
#include "flagstone/moving_points.hpp"              // IWYU pragma: export
#include "flagstone/patch.hpp"                      // IWYU pragma: export
#include "flagstone/patchwork.hpp"                  // IWYU pragma: export
#include "flagstone/patchwork_config.hpp"           // IWYU pragma: export
#include "flagstone/segmentation.hpp"               // IWYU pragma: export
#include "flagstone/segmenter.hpp"                  // IWYU pragma: export
#include "flagstone/sensor.hpp"                     // IWYU pragma: export
#include "flagstone/stage_times.hpp"                // IWYU pragma: export
#include "flagstone/status.hpp"                     // IWYU pragma: export
#include "flagstone/surface.hpp"                    // IWYU pragma: export
#include "flagstone/surface_config.hpp"             // IWYU pragma: export
#include "flagstone/version.hpp"                    // IWYU pragma: export

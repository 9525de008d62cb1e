// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace flagstone {

/// Ground truth of a point, from reference labels and an evaluation protocol.
enum class Truth : std::uint8_t {
  ground,
  not_ground,
  ignored,  ///< not scored
};

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace flagstone {

/// The class of a point. Every input point gets exactly one label. Label files contain these codes,
/// so the codes will not change.
enum class Label : std::uint8_t {
  nonground = 0,     ///< on an object, above the ground, or in a patch that is not ground
  ground = 1,        ///< on the ground surface
  noise = 2,         ///< below any possible ground, such as ghost points from reflections
  out_of_range = 3,  ///< too far, too near, outside the field of view, or |z| above 10 km
  invalid = 4,       ///< a coordinate is not finite, or all three are zero (missing return)
};

/// Number of label codes. Codes are 0 to label_count - 1.
inline constexpr std::size_t label_count = 5;

/// Name of a label, for example "out_of_range".
constexpr const char* to_string(Label label) noexcept {
  switch (label) {
    case Label::nonground: return "nonground";
    case Label::ground: return "ground";
    case Label::noise: return "noise";
    case Label::out_of_range: return "out_of_range";
    case Label::invalid: return "invalid";
  }
  return "unknown";
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace flagstone {

/// What a point is. The codes are part of the data contract: they are what label files hold and
/// will not change. Every input point gets exactly one.
enum class Label : std::uint8_t {
  nonground = 0,  ///< stands on the ground, hangs above it, or lies in a patch that is not ground
  ground = 1,     ///< belongs to the ground surface
  noise = 2,      ///< below any ground there can be at that place (multipath, reflections)
  out_of_range = 3,  ///< too far, too near or out of view for the method, or over 10 km up or down
  invalid = 4,       ///< a coordinate is not finite, or all three are zero ("no echo")
};

/// Number of label codes; codes run from 0 to label_count - 1.
inline constexpr std::size_t label_count = 5;

/// Name of a label as the data contract spells it, e.g. "out_of_range".
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

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lab/sim/semantic_class.hpp"

namespace flagstone::sim {

/// What a point of a scan is an echo of; the codes are those of the files NNNNNN.echo.npy.
enum class EchoKind : std::uint8_t {
  surface,    ///< what the beam met first: the only kind that has a class other than outlier
  ghost,      ///< something seen in a mirror, reported straight on, behind the mirror
  mixed,      ///< two surfaces at once at an edge, reported between them
  rain,       ///< a drop
  dust,       ///< a cloud of dust
  crosstalk,  ///< the light of another sensor
  none,       ///< nothing came back: a point at (0, 0, 0), only where these are kept
};
inline constexpr std::array<std::string_view, 7> echo_kind_names{
    "surface", "ghost", "mixed", "rain", "dust", "crosstalk", "none"};

/// What the sensor reports for a beam.
struct Echo {
  double range;      ///< metres
  double intensity;  ///< 0..1
  SemanticClass semantic;
  EchoKind kind = EchoKind::surface;
};

}  // namespace flagstone::sim

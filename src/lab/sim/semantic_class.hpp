// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace flagstone::sim {

/// What a surface is; the codes are SemanticKITTI's label ids. J. Behley et al., "SemanticKITTI: A
/// Dataset for Semantic Scene Understanding of LiDAR Sequences", ICCV 2019.
enum class SemanticClass : std::uint8_t {
  outlier = 1,  ///< no surface: ghosts, mixed pixels, rain, dust, crosstalk
  car = 10,
  bus = 13,
  truck = 18,
  other_vehicle = 20,  ///< excavators, tractors, forklifts
  person = 30,
  bicyclist = 31,  ///< with the bicycle
  road = 40,
  parking = 44,
  sidewalk = 48,  ///< kerb faces too: annotators colour the whole kerb with the sidewalk
  other_ground = 49,
  building = 50,
  fence = 51,            ///< crash barriers and low walls too
  other_structure = 52,  ///< walls that hold land, tunnels, gantries, shelters, racks
  lane_marking = 60,
  vegetation = 70,
  trunk = 71,
  terrain = 72,
  pole = 80,
  traffic_sign = 81,
  other_object = 99,  ///< what stands about: benches, bins, pallets, heaps
};

/// SemanticKITTI's name, e.g. "lane-marking"; empty for a code that is none of these.
std::string_view name_of(SemanticClass semantic) noexcept;

/// Is this a class of the ground surface (40, 44, 48, 49, 60, 72)?
constexpr bool is_ground(SemanticClass semantic) noexcept {
  switch (semantic) {
    case SemanticClass::road:
    case SemanticClass::parking:
    case SemanticClass::sidewalk:
    case SemanticClass::other_ground:
    case SemanticClass::lane_marking:
    case SemanticClass::terrain: return true;
    default: return false;
  }
}

}  // namespace flagstone::sim

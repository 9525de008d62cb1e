// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/semantic_class.hpp"

namespace flagstone::sim {

std::string_view name_of(SemanticClass semantic) noexcept {
  switch (semantic) {
    case SemanticClass::outlier: return "outlier";
    case SemanticClass::car: return "car";
    case SemanticClass::bus: return "bus";
    case SemanticClass::truck: return "truck";
    case SemanticClass::other_vehicle: return "other-vehicle";
    case SemanticClass::person: return "person";
    case SemanticClass::bicyclist: return "bicyclist";
    case SemanticClass::road: return "road";
    case SemanticClass::parking: return "parking";
    case SemanticClass::sidewalk: return "sidewalk";
    case SemanticClass::other_ground: return "other-ground";
    case SemanticClass::building: return "building";
    case SemanticClass::fence: return "fence";
    case SemanticClass::other_structure: return "other-structure";
    case SemanticClass::lane_marking: return "lane-marking";
    case SemanticClass::vegetation: return "vegetation";
    case SemanticClass::trunk: return "trunk";
    case SemanticClass::terrain: return "terrain";
    case SemanticClass::pole: return "pole";
    case SemanticClass::traffic_sign: return "traffic-sign";
    case SemanticClass::other_object: return "other-object";
  }
  return {};
}

}  // namespace flagstone::sim

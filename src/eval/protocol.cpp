// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/protocol.hpp"

#include <algorithm>
#include <cstddef>

namespace flagstone::eval {
namespace {

/// SemanticKITTI: road, parking, sidewalk, other ground, lane marking, terrain.
const std::vector<std::uint32_t> semantic_kitti_ground = {40, 44, 48, 49, 60, 72};

Truth truth_of(const Protocol& protocol, std::uint32_t id, float z) {
  if (std::ranges::find(protocol.ground, id) != protocol.ground.end()) return Truth::ground;
  if (std::ranges::find(protocol.ignored, id) != protocol.ignored.end()) return Truth::ignored;
  const auto low = std::ranges::find(protocol.low_ground, id, &Protocol::LowGround::id);
  return low != protocol.low_ground.end() && z < low->height ? Truth::ground : Truth::not_ground;
}

}  // namespace

const Protocol& patchwork_protocol() {
  static const Protocol protocol{"patchwork", semantic_kitti_ground, {}, {{70, -1.3f}}};
  return protocol;
}

const Protocol& patchwork_plusplus_protocol() {
  static const Protocol protocol{"patchwork++", semantic_kitti_ground, {0, 1, 70}, {}};
  return protocol;
}

const Protocol& lidarseg_protocol() {
  static const Protocol protocol{"lidarseg", {24, 25, 26, 27}, {0, 31}, {}};
  return protocol;
}

const Protocol& simulation_protocol() {
  static const Protocol protocol{"simulation", semantic_kitti_ground, {}, {}};
  return protocol;
}

std::vector<Truth> truth_of(const Protocol& protocol, CloudView cloud,
                            std::span<const std::uint32_t> classes) {
  std::vector<Truth> truth(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    truth[i] = truth_of(protocol, classes[i], cloud[i].z);
  }
  return truth;
}

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/protocol.hpp"

#include <array>
#include <cstddef>
#include <limits>

namespace flagstone::eval {
namespace {

/// SemanticKITTI: road, parking, sidewalk, other ground, lane marking, terrain.
const std::vector<std::uint32_t> semantic_kitti_ground = {40, 44, 48, 49, 60, 72};

/// What a class is, by its id: a table up to the largest id that the protocol names.
class ClassTable {
 public:
  explicit ClassTable(const Protocol& protocol) {
    for (const Protocol::LowGround& low : protocol.low_ground) entry(low.id).below = low.height;
    for (const std::uint32_t id : protocol.ignored) entry(id) = {never, Truth::ignored};
    for (const std::uint32_t id : protocol.ground) entry(id) = {never, Truth::ground};
  }

  [[nodiscard]] Truth truth(std::uint32_t id, float z) const noexcept {
    if (id >= entries_.size()) return Truth::not_ground;
    return z < entries_[id].below ? Truth::ground : entries_[id].otherwise;
  }

 private:
  static constexpr float never = -std::numeric_limits<float>::infinity();
  struct Entry {
    float below = never;  // the class is ground below this height
    Truth otherwise = Truth::not_ground;
  };

  Entry& entry(std::uint32_t id) {
    if (id >= entries_.size()) entries_.resize(id + std::size_t{1});
    return entries_[id];
  }

  std::vector<Entry> entries_;
};

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

std::span<const Protocol* const> known_protocols() noexcept {
  static const std::array protocols = {&patchwork_protocol(), &patchwork_plusplus_protocol(),
                                       &lidarseg_protocol(), &simulation_protocol()};
  return protocols;
}

std::vector<Truth> truth_of(const Protocol& protocol, CloudView cloud,
                            std::span<const std::uint32_t> classes) {
  std::vector<Truth> truth;
  truth_of(protocol, cloud, classes, truth);
  return truth;
}

void truth_of(const Protocol& protocol, CloudView cloud, std::span<const std::uint32_t> classes,
              std::vector<Truth>& truth) {
  const ClassTable table(protocol);
  truth.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) truth[i] = table.truth(classes[i], cloud[i].z);
}

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sim/ground.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/ray_caster.hpp"
#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// A world before anything stands on it. Its ground is quick to make and enough to know every pose;
/// what stands on it takes longer and is made where it is asked for.
struct Landscape {
  Ground ground;
  std::vector<Stop> route;
  std::function<Mesh(const Ground&)> furnish;  ///< the same mesh on every call
  std::vector<GroundStep> steps{};             ///< those that are known, of scenes that list them

  /// What moves: traffic and people as they are at the stop of this number, the same mesh on every
  /// call. Empty where nothing moves.
  std::function<Mesh(const Ground&, int stop)> moving{};
};

/// A ground and what stands on it, ready to be cast against.
class Scene {
 public:
  /// `objects` is everything but the ground, whose triangles are added here.
  Scene(Ground ground, Mesh objects)
      : ground_(std::move(ground)), caster_(with_ground(ground_, std::move(objects))) {}

  [[nodiscard]] const Ground& ground() const noexcept { return ground_; }
  [[nodiscard]] const RayCaster& caster() const noexcept { return caster_; }

 private:
  static Mesh with_ground(const Ground& ground, Mesh objects) {
    ground.add_to(objects);
    return objects;
  }

  Ground ground_;
  RayCaster caster_;
};

/// A kind of surroundings by name, of which every seed draws another world.
struct SceneKind {
  std::string_view name;
  std::string_view summary;  ///< a line for a list
  Landscape (*make)(std::uint64_t seed);
};

/// All kinds there are, in the order in which they are listed.
std::span<const SceneKind> scene_kinds() noexcept;

/// The kind of this name; null if there is none.
const SceneKind* find_scene_kind(std::string_view name) noexcept;

}  // namespace flagstone::sim

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

/// A scene before it is built. The ground is cheap to make and sufficient for the poses. The
/// objects on it take longer and are made on demand.
struct Landscape {
  Ground ground;
  std::vector<Stop> route;
  std::function<Mesh(const Ground&)> furnish;  ///< the same mesh on every call
  std::vector<GroundStep> steps{};             ///< known steps; empty in most scenes

  /// Moving objects, traffic and people, with their motion, at a time since the first stop: the
  /// same mesh on every call. Empty if nothing moves.
  std::function<Mesh(const Ground&, double seconds)> moving{};
};

/// A ground and the objects on it, ready for ray casting.
class Scene {
 public:
  /// `objects` must not contain the ground, whose triangles are added here.
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

/// A named kind of scene. Every seed gives a different instance.
struct SceneKind {
  std::string_view name;
  std::string_view summary;  ///< one line for a list
  Landscape (*make)(std::uint64_t seed);
};

/// All kinds, in the order of lists.
std::span<const SceneKind> scene_kinds() noexcept;

/// The kind of this name; null if there is none.
const SceneKind* find_scene_kind(std::string_view name) noexcept;

}  // namespace flagstone::sim

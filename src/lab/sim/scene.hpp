// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "lab/sim/ground.hpp"
#include "lab/sim/ray_caster.hpp"

namespace flagstone::sim {

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

}  // namespace flagstone::sim

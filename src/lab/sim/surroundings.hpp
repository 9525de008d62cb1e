// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include "lab/sim/ray_caster.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {

/// What beams meet at one stop: a scene, and what moves in it as it is then. Refers to both.
class Surroundings {
 public:
  struct Meeting {
    double range;            ///< metres along the beam
    double incidence;        ///< cosine of the angle between beam and surface normal, 0..1
    Vector3 normal;          ///< of length 1, on either side
    const Surface* surface;  ///< of the scene or of what moves
  };

  /// `moving` may be null: nothing does.
  Surroundings(const Scene& scene, const RayCaster* moving) : scene_(&scene), moving_(moving) {}

  [[nodiscard]] const Ground& ground() const noexcept { return scene_->ground(); }

  /// What is nearest between `near` and `far` metres from `origin`; `direction` has length 1.
  [[nodiscard]] std::optional<Meeting> cast(Vector3 origin, Vector3 direction, double near,
                                            double far) const noexcept {
    std::optional<Meeting> nearest;
    for (const RayCaster* caster : {&scene_->caster(), moving_}) {
      if (caster == nullptr) continue;
      const auto hit = caster->cast(origin, direction, near, nearest ? nearest->range : far);
      if (!hit) continue;
      nearest = Meeting{.range = hit->range,
                        .incidence = hit->incidence,
                        .normal = hit->normal,
                        .surface = &caster->mesh().surface(hit->triangle)};
    }
    return nearest;
  }

  /// Is a point so far above or below the ground that range noise does not carry it there?
  [[nodiscard]] bool is_clear_of_ground(Vector3 point) const noexcept {
    return std::abs(point.z - ground().height(point.x, point.y)) > clearance;
  }
  [[nodiscard]] bool is_below_ground(Vector3 point) const noexcept {
    return point.z < ground().height(point.x, point.y) - clearance;
  }

 private:
  static constexpr double clearance = 0.15;  // metres

  const Scene* scene_;
  const RayCaster* moving_;
};

}  // namespace flagstone::sim

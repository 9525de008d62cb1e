// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sim/extent.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/ray_caster.hpp"
#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// A scene before it is built, in road coordinates. The ground is cheap to make and sufficient for
/// the poses. The objects on it take longer and are made on demand, stretch by stretch.
struct Landscape {
  Ground ground;
  std::vector<Stop> route;
  /// The same mesh on every call.
  std::function<Mesh(const Ground&, const Stretch&)> furnish;
  std::vector<GroundStep> steps{};  ///< known steps; empty in most scenes

  /// Moving objects, traffic and people, with their motion, at a time since the first stop: the
  /// same mesh on every call. Empty if nothing moves.
  std::function<Mesh(const Ground&, double seconds)> moving{};
};

/// A ground and the objects on it, ready for ray casting.
class Scene {
 public:
  /// `objects` must not contain the ground, whose triangles are added here.
  Scene(Ground ground, Mesh objects) : ground_(std::make_shared<const Ground>(std::move(ground))) {
    ground_->add_to(objects);
    casters_.push_back(std::make_shared<const RayCaster>(std::move(objects)));
  }

  /// Parts of a large scene; each caster contains its part of the ground.
  Scene(std::shared_ptr<const Ground> ground, std::vector<std::shared_ptr<const RayCaster>> casters)
      : ground_(std::move(ground)), casters_(std::move(casters)) {}

  [[nodiscard]] const Ground& ground() const noexcept { return *ground_; }
  [[nodiscard]] std::size_t parts() const noexcept { return casters_.size(); }
  [[nodiscard]] const RayCaster& caster(std::size_t part = 0) const noexcept {
    return *casters_[part];
  }

 private:
  std::shared_ptr<const Ground> ground_;
  std::vector<std::shared_ptr<const RayCaster>> casters_;
};

/// A named kind of scene. Every seed gives a different instance.
struct SceneKind {
  std::string_view name;
  std::string_view summary;  ///< one line for a list
  Landscape (*make)(std::uint64_t seed);

  /// A longer instance, or a circuit; null if this kind of scene has only one stretch.
  Landscape (*make_long)(std::uint64_t seed, const Extent& extent) = nullptr;
};

/// All kinds, in the order of lists.
std::span<const SceneKind> scene_kinds() noexcept;

/// The kind of this name; null if there is none.
const SceneKind* find_scene_kind(std::string_view name) noexcept;

}  // namespace flagstone::sim

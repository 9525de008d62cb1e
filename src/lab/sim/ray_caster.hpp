// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// Finds the first triangle that a beam hits. cast() is thread-safe.
class RayCaster {
 public:
  struct Hit {
    double range;            ///< metres along the beam
    std::uint32_t triangle;  ///< index into the mesh
    double incidence;        ///< cosine of the angle between beam and surface normal, 0..1
    Vector3 normal{};        ///< of the triangle, of length 1, on either side
  };

  /// Throws std::invalid_argument if a triangle refers to a vertex that does not exist, and
  /// std::bad_alloc if the search structure cannot be built.
  explicit RayCaster(Mesh mesh);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// The first triangle between `near` and `far` metres from `origin`; `direction` has length 1.
  [[nodiscard]] std::optional<Hit> cast(Vector3 origin, Vector3 direction, double near,
                                        double far) const noexcept;

  [[nodiscard]] const Mesh& mesh() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flagstone::sim

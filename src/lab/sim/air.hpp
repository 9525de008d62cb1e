// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/echo.hpp"
#include "lab/sim/frame.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/surroundings.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// What is in the air during one scan: rain, and clouds of dust that lie about the vehicle and
/// behind it. Nothing in it comes within Surroundings' clearance of the ground.
class Air {
 public:
  /// Refers to what it is given.
  Air(const Noise& noise, const Sensor& sensor, const Surroundings& surroundings, const Frame& pose,
      std::uint64_t seed);

  /// What the air sends back of a beam, if anything does, before it has gone `way` metres.
  [[nodiscard]] std::optional<Echo> echo(Vector3 direction, double way, Random& random) const;

  /// Share of the light that comes through from `way` metres off: the way back from there, since
  /// the way there is one that echo() let pass, and both ways through the rain.
  [[nodiscard]] double transmission(Vector3 direction, double way) const;

 private:
  struct Cloud {
    Vector3 centre;
    double radius;
  };
  // Of a beam in a cloud, metres along the beam.
  struct Stretch {
    double begin, end;
    double middle;        // of the chord through the whole cloud
    double half_squared;  // of that chord's length
    double radius;        // of the cloud

    // Density at `range`, 0 to 1: 1 in the middle of a cloud, falling to 0 at its rim.
    [[nodiscard]] double density(double range) const noexcept;
    // Sum of the density over the stretch, metres.
    [[nodiscard]] double depth() const noexcept;
  };

  [[nodiscard]] Stretch within(const Cloud& cloud, Vector3 direction, double way) const noexcept;
  [[nodiscard]] std::optional<Echo> drop(Vector3 direction, double way, Random& random) const;
  [[nodiscard]] std::optional<Echo> dust(Vector3 direction, double way, Random& random) const;

  const Noise& noise_;
  const Sensor& sensor_;
  const Surroundings& surroundings_;
  Vector3 origin_;
  std::vector<Cloud> clouds_;
};

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "flagstone/sensor.hpp"
#include "lab/sim/air.hpp"
#include "lab/sim/beams.hpp"
#include "lab/sim/bursts.hpp"
#include "lab/sim/echo.hpp"
#include "lab/sim/frame.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/surroundings.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Follows single beams of one scan. Everything random about a beam comes from streams of its own,
/// so that several threads may ask for beams in any order. Refers to what it is given.
class Measurement {
 public:
  Measurement(const Surroundings& surroundings, const Sensor& sensor, const Noise& noise,
              const Beams& beams, const Frame& pose, std::uint64_t seed);

  /// What the sensor reports for a beam, if anything.
  [[nodiscard]] std::optional<Echo> operator()(std::size_t beam) const;

 private:
  using Meeting = Surroundings::Meeting;

  [[nodiscard]] std::optional<Echo> echo_of_surface(Vector3 direction, const Meeting& met,
                                                    Random random, Random& extra) const;
  [[nodiscard]] double share_mirrored(const Meeting& met) const noexcept;
  [[nodiscard]] std::optional<Echo> seen_in_mirror(Vector3 direction, const Meeting& mirror,
                                                   Random& random) const;
  [[nodiscard]] std::optional<Echo> ghost_below(Vector3 direction, const Meeting& mirror,
                                                Random& random) const;
  [[nodiscard]] std::optional<Echo> mixed_at_edge(Vector3 direction, const Meeting& met,
                                                  Random& random) const;
  [[nodiscard]] std::optional<Echo> reported(double range, double reflectivity, double incidence,
                                             SemanticClass semantic, EchoKind kind,
                                             Random& random) const;

  const Surroundings& surroundings_;
  const Sensor& sensor_;
  const Noise& noise_;
  const Beams& beams_;
  const Frame& pose_;
  std::uint64_t seed_;
  Bursts bursts_;
  Air air_;
};

}  // namespace flagstone::sim

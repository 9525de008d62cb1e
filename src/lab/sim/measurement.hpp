// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/beams.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/ray_caster.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// The return that the sensor reports for a beam.
struct Echo {
  double range;            ///< metres
  double intensity;        ///< 0..1
  SemanticClass semantic;  ///< labelled_class() of the surface
  Motion motion = Motion::none;
  EchoKind kind = EchoKind::surface;
};

/// The objects that beams can hit at one stop: a scene, and the moving objects at that time. Keeps
/// references to both.
class Surroundings {
 public:
  struct Meeting {
    double range;            ///< metres along the beam
    double incidence;        ///< cosine of the angle between beam and surface normal, 0..1
    Vector3 normal;          ///< of length 1, on either side
    const Surface* surface;  ///< of the scene or of a moving object
  };

  /// `moving` may be null: nothing moves.
  Surroundings(const Scene& scene, const RayCaster* moving) : scene_(&scene), moving_(moving) {}

  [[nodiscard]] const Ground& ground() const noexcept { return scene_->ground(); }

  /// The nearest hit between `near` and `far` metres from `origin`; `direction` has length 1.
  [[nodiscard]] std::optional<Meeting> cast(Vector3 origin, Vector3 direction, double near,
                                            double far) const noexcept {
    std::optional<Meeting> nearest;
    const auto cast_in = [&](const RayCaster& caster) {
      const auto hit = caster.cast(origin, direction, near, nearest ? nearest->range : far);
      if (!hit) return;
      nearest = Meeting{.range = hit->range,
                        .incidence = hit->incidence,
                        .normal = hit->normal,
                        .surface = &caster.mesh().surface(hit->triangle)};
    };
    for (std::size_t part = 0; part < scene_->parts(); ++part) cast_in(scene_->caster(part));
    if (moving_ != nullptr) cast_in(*moving_);
    return nearest;
  }

  /// Whether a point is so far above or below the ground that range noise cannot move it there.
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

/// The air during one scan: rain, and dust clouds around and behind the vehicle. None of its
/// returns is within the clearance of Surroundings from the ground.
class Air {
 public:
  /// Keeps references to its arguments.
  Air(const Noise& noise, const Sensor& sensor, const Surroundings& surroundings, const Frame& pose,
      std::uint64_t seed);

  /// The return from the air within `way` metres of `origin`, if there is one.
  [[nodiscard]] std::optional<Echo> echo(Vector3 origin, Vector3 direction, double way,
                                         Random& random) const;

  /// Fraction of the light that is transmitted from `way` metres away. Through dust this counts
  /// only the return path, because `echo()` already let the outward path pass; through rain, both
  /// paths.
  [[nodiscard]] double transmission(Vector3 origin, Vector3 direction, double way) const;

 private:
  struct Cloud {
    Vector3 centre;
    double radius;
  };
  // The part of a beam that is in a cloud, metres along the beam.
  struct Stretch {
    double begin, end;
    double middle;        // of the chord through the whole cloud
    double half_squared;  // square of half the length of the chord
    double radius;        // of the cloud

    // Density at `range`: 1 in the middle of a cloud, decreasing to 0 at its rim.
    [[nodiscard]] double density(double range) const noexcept;
    // Integral of the density over this part, metres.
    [[nodiscard]] double depth() const noexcept;
  };

  [[nodiscard]] Stretch within(const Cloud& cloud, Vector3 origin, Vector3 direction,
                               double way) const noexcept;
  [[nodiscard]] std::optional<Echo> drop(Vector3 origin, Vector3 direction, double way,
                                         Random& random) const;
  [[nodiscard]] std::optional<Echo> dust(Vector3 origin, Vector3 direction, double way,
                                         Random& random) const;

  const Noise& noise_;
  const Sensor& sensor_;
  const Surroundings& surroundings_;
  std::vector<Cloud> clouds_;
};

/// Effects on many beams of a scan together, drawn before the beams are cast.
class Bursts {
 public:
  Bursts(const Noise& noise, const Sensor& sensor, const Beams& beams, std::uint64_t seed);

  /// Whether the beam is in a lost block.
  [[nodiscard]] bool is_lost(std::size_t beam) const noexcept {
    return !lost_.empty() && lost_[beam];
  }

  /// The false range from the light of another sensor, metres, if it hit this beam.
  [[nodiscard]] std::optional<double> crosstalk(std::size_t beam) const noexcept {
    if (crosstalk_.empty() || crosstalk_[beam] == 0) return std::nullopt;
    return crosstalk_[beam];
  }

 private:
  void lose_blocks(double rate, const Beams& beams, Random random);
  void add_crosstalk(double rate, const Sensor& sensor, const Beams& beams, Random random);

  std::vector<bool> lost_;         // one per beam, or empty if none is lost
  std::vector<double> crosstalk_;  // one per beam, 0 without crosstalk; or empty
};

/// The sensor and the objects around it when beams are fired.
struct Instant {
  Frame pose;
  Surroundings surroundings;
};

/// Measures single beams of one scan. Each beam has separate random streams, so several threads can
/// measure beams in any order with the same result. Keeps references to its arguments.
class Measurement {
 public:
  /// `instants` has one element for each firing of a row, or one for all of them. The air is as at
  /// the first one.
  Measurement(std::span<const Instant> instants, const Sensor& sensor, const Noise& noise,
              const Beams& beams, std::uint64_t seed);

  /// The return that the sensor reports for a beam, if there is one.
  [[nodiscard]] std::optional<Echo> operator()(std::size_t beam) const;

 private:
  using Meeting = Surroundings::Meeting;

  [[nodiscard]] std::optional<Echo> echo_of_surface(const Instant& instant, Vector3 direction,
                                                    const Meeting& met, Random random,
                                                    Random& extra) const;
  [[nodiscard]] double share_mirrored(const Meeting& met) const noexcept;
  [[nodiscard]] std::optional<Echo> seen_in_mirror(const Instant& instant, Vector3 direction,
                                                   const Meeting& mirror, Random& random) const;
  [[nodiscard]] std::optional<Echo> ghost_below(const Instant& instant, Vector3 direction,
                                                const Meeting& mirror, Random& random) const;
  [[nodiscard]] std::optional<Echo> mixed_at_edge(const Instant& instant, Vector3 direction,
                                                  const Meeting& met, Random& random) const;
  [[nodiscard]] std::optional<Echo> reported(double range, double reflectivity, double incidence,
                                             SemanticClass semantic, EchoKind kind,
                                             Random& random) const;

  std::span<const Instant> instants_;
  const Sensor& sensor_;
  const Noise& noise_;
  const Beams& beams_;
  std::uint64_t seed_;
  Bursts bursts_;
  Air air_;
};

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/scan.hpp"

#include <algorithm>
#include <optional>
#include <thread>

#include "core/random.hpp"
#include "sim/beams.hpp"

namespace flagstone::sim {
namespace {

struct Echo {
  double range;
  double intensity;
  SemanticClass semantic;
};

// Follows single beams. Everything random about a beam comes from a stream of its own.
class Measurement {
 public:
  Measurement(const Scene& scene, const Sensor& sensor, const Noise& noise, const Frame& pose)
      : scene_(scene), sensor_(sensor), noise_(noise), pose_(pose) {}

  [[nodiscard]] std::optional<Echo> operator()(Vector3 beam, Random random) const {
    const Vector3 direction = pose_.direction_to_world(beam);
    const auto hit =
        scene_.caster().cast(pose_.origin, direction, sensor_.min_range, sensor_.max_range);
    if (!hit) return std::nullopt;

    const Surface& surface = scene_.caster().mesh().surface(hit->triangle);
    if (is_ground(surface.semantic)) {
      if (const auto ghost = ghost_behind(*hit, direction, random)) return ghost;
    }
    if (!is_detected(noise_, hit->range, surface.reflectivity, hit->incidence, random)) {
      return std::nullopt;
    }
    return reported(hit->range, surface.reflectivity, hit->incidence, surface.semantic, random);
  }

 private:
  // Multipath: the ground mirrors the beam, the echo comes back the same way, and the sensor, which
  // knows of no mirror, puts the point straight on, at the mirror image of what was hit below the
  // ground.
  [[nodiscard]] std::optional<Echo> ghost_behind(const RayCaster::Hit& mirror, Vector3 direction,
                                                 Random& random) const {
    if (!is_mirrored(noise_, mirror.range, random)) return std::nullopt;
    const Mesh& mesh = scene_.caster().mesh();
    const Vector3 a = mesh.corner(mirror.triangle, 0);
    const Vector3 normal =
        normalized(cross(mesh.corner(mirror.triangle, 1) - a, mesh.corner(mirror.triangle, 2) - a));
    const Vector3 reflected = direction - 2 * dot(direction, normal) * normal;
    const Vector3 at = pose_.origin + mirror.range * direction;
    constexpr double clear_of_mirror = 0.05;
    const auto object =
        scene_.caster().cast(at, reflected, clear_of_mirror, noise_.ghost_max_range - mirror.range);
    if (!object) return std::nullopt;
    const Surface& surface = mesh.surface(object->triangle);
    const double path = mirror.range + object->range;
    if (is_ground(surface.semantic) || !is_below_ground(pose_.origin + path * direction)) {
      return std::nullopt;
    }
    constexpr double lost_in_mirror = 0.3;
    return reported(path, lost_in_mirror * surface.reflectivity, object->incidence,
                    SemanticClass::outlier, random);
  }

  // By so much that range noise does not lift it out again.
  [[nodiscard]] bool is_below_ground(Vector3 point) const noexcept {
    constexpr double margin = 0.15;
    return point.z < scene_.ground().height(point.x, point.y) - margin;
  }

  [[nodiscard]] std::optional<Echo> reported(double range, double reflectivity, double incidence,
                                             SemanticClass semantic, Random& random) const {
    const double measured = measured_range(noise_, sensor_, range, random);
    if (measured < sensor_.min_range || measured > sensor_.max_range) return std::nullopt;
    return Echo{.range = measured,
                .intensity = measured_intensity(noise_, reflectivity, incidence, random),
                .semantic = semantic};
  }

  const Scene& scene_;
  const Sensor& sensor_;
  const Noise& noise_;
  const Frame& pose_;
};

SimulatedScan collect(const Beams& beams, const std::vector<std::optional<Echo>>& echoes) {
  SimulatedScan scan;
  scan.xyzi.reserve(4 * beams.size());
  scan.classes.reserve(beams.size());
  for (std::size_t beam = 0; beam < beams.size(); ++beam) {
    const std::optional<Echo>& echo = echoes[beam];
    if (!echo) continue;
    const Vector3 point = echo->range * beams[beam];
    for (const double value : {point.x, point.y, point.z, echo->intensity}) {
      scan.xyzi.push_back(static_cast<float>(value));
    }
    scan.classes.push_back(static_cast<std::uint32_t>(echo->semantic));
  }
  return scan;
}

}  // namespace

SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       const Frame& pose, std::uint64_t seed, const ScanOptions& options) {
  const unsigned threads = std::max(1U, options.threads);
  const Beams beams(sensor, options.number);
  const Measurement measure(scene, sensor, noise, pose);
  std::vector<std::optional<Echo>> echoes(beams.size());
  const auto cast_block = [&](std::size_t begin, std::size_t end) {
    for (std::size_t beam = begin; beam < end; ++beam) {
      echoes[beam] = measure(beams[beam], Random::stream(seed, beam));
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned block = 1; block < threads; ++block) {
      others.emplace_back(cast_block, beams.size() * block / threads,
                          beams.size() * (block + 1) / threads);
    }
    cast_block(0, beams.size() / threads);
  }
  return collect(beams, echoes);
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/scan.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lab/sim/beams.hpp"
#include "lab/sim/measurement.hpp"
#include "library/core/thread_pool.hpp"

namespace flagstone::sim {
namespace {

SimulatedScan collect(const Beams& beams, const std::vector<std::optional<Echo>>& echoes,
                      bool keep_no_returns) {
  SimulatedScan scan;
  scan.xyzi.reserve(4 * beams.size());
  scan.classes.reserve(beams.size());
  scan.echoes.reserve(beams.size());
  scan.motions.reserve(beams.size());
  scan.firings.reserve(beams.size());
  for (std::size_t beam = 0; beam < beams.size(); ++beam) {
    const std::optional<Echo>& echo = echoes[beam];
    if (!echo && !keep_no_returns) continue;
    scan.firings.push_back(static_cast<std::uint32_t>(beam % beams.row_length()));
    if (!echo) {
      scan.xyzi.insert(scan.xyzi.end(), 4, 0.0F);
      scan.classes.push_back(0);
      scan.echoes.push_back(EchoKind::none);
      scan.motions.push_back(Motion::none);
      continue;
    }
    const Vector3 point = echo->range * beams[beam];
    for (const double value : {point.x, point.y, point.z, echo->intensity}) {
      scan.xyzi.push_back(static_cast<float>(value));
    }
    scan.classes.push_back(static_cast<std::uint32_t>(echo->semantic));
    scan.echoes.push_back(echo->kind);
    scan.motions.push_back(echo->motion);
  }
  return scan;
}

}  // namespace

SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       const Frame& pose, std::uint64_t seed, const ScanOptions& options) {
  const Firing always{.pose = pose, .moving = options.moving};
  return simulate(scene, sensor, noise, std::span(&always, 1), seed, options);
}

SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       std::span<const Firing> firings, std::uint64_t seed,
                       const ScanOptions& options) {
  const unsigned threads = std::max(1U, options.threads);
  const Beams beams(sensor, options.number);
  std::vector<Instant> instants;
  for (const Firing& firing : firings) {
    instants.push_back({.pose = firing.pose, .surroundings = {scene, firing.moving}});
  }
  const Measurement measure(instants, sensor, noise, beams, seed);
  std::vector<std::optional<Echo>> echoes(beams.size());
  ThreadPool(threads).run(
      beams.size(), [&](std::size_t, std::size_t beam) noexcept { echoes[beam] = measure(beam); });
  return collect(beams, echoes, options.keep_no_returns);
}

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {

/// Kinds of returns, with the codes of the files NNNNNN.return.npy.
enum class EchoKind : std::uint8_t {
  surface,    ///< the first surface on the beam: the only kind with a class other than outlier
  ghost,      ///< ghost point: specular reflection of an object, reported behind the surface
  mixed,      ///< mixed pixel: two surfaces at an edge, reported between them
  rain,       ///< a raindrop
  dust,       ///< a dust cloud
  crosstalk,  ///< the light of another sensor
  none,       ///< missing return: a point at (0, 0, 0), only if these are kept
};
inline constexpr std::array<std::string_view, 7> echo_kind_names{
    "surface", "ghost", "mixed", "rain", "dust", "crosstalk", "none"};

/// One scan, with its points in the order of Beams.
struct SimulatedScan {
  std::vector<float>
      xyzi;  ///< 4 floats per point: x, y, z in metres, sensor frame, and intensity 0..1
  std::vector<std::uint32_t>
      classes;  ///< SemanticKITTI id of each point, see SemanticClass; 0 for missing returns
  std::vector<EchoKind> echoes;        ///< kind of each return
  std::vector<Motion> motions;         ///< of the object at each point
  std::vector<std::uint32_t> firings;  ///< number of the firing of each point within its row

  [[nodiscard]] std::size_t size() const noexcept { return classes.size(); }
};

/// The sensor when it fires, and the moving objects at that time; null: none.
struct Firing {
  Frame pose;
  const RayCaster* moving = nullptr;
};

/// Options of one scan, in addition to scene and sensor.
struct ScanOptions {
  int number = 0;                     ///< number of the scan for a rosette, see Beams
  const RayCaster* moving = nullptr;  ///< moving objects at this time; null: none
  bool keep_no_returns = false;       ///< missing returns become points at (0, 0, 0), class 0
  unsigned threads = 1;               ///< 0 counts as 1; the result does not depend on it
};

/// Casts every beam of one scan. Deterministic.
SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       const Frame& pose, std::uint64_t seed, const ScanOptions& options = {});

/// The same while the sensor moves: `firings` has an element for each of sensor.firings, instead of
/// one pose and options.moving. Every point is relative to the pose at its own firing.
SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       std::span<const Firing> firings, std::uint64_t seed,
                       const ScanOptions& options = {});

}  // namespace flagstone::sim

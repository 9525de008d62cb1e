// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {

/// What a point of a scan is an echo of; the codes are those of the files NNNNNN.return.npy.
enum class EchoKind : std::uint8_t {
  surface,    ///< what the beam met first: the only kind that has a class other than outlier
  ghost,      ///< something seen in a mirror, reported straight on, behind the mirror
  mixed,      ///< two surfaces at once at an edge, reported between them
  rain,       ///< a drop
  dust,       ///< a cloud of dust
  crosstalk,  ///< the light of another sensor
  none,       ///< nothing came back: a point at (0, 0, 0), only where these are kept
};
inline constexpr std::array<std::string_view, 7> echo_kind_names{
    "surface", "ghost", "mixed", "rain", "dust", "crosstalk", "none"};

/// One scan of the sensor: points in the order of its beams, see Beams.
struct SimulatedScan {
  std::vector<float>
      xyzi;  ///< 4 floats a point: x, y, z in metres, sensor frame, and intensity 0..1
  std::vector<std::uint32_t>
      classes;  ///< SemanticKITTI id of each point, see SemanticClass; 0 without echo
  std::vector<EchoKind> echoes;  ///< what each point is an echo of

  [[nodiscard]] std::size_t size() const noexcept { return classes.size(); }
};

/// Of one scan, what is neither world nor sensor.
struct ScanOptions {
  int number = 0;                     ///< which scan of a rosette, see Beams
  const RayCaster* moving = nullptr;  ///< what moves, as it is now; null: nothing
  bool keep_no_returns = false;       ///< beams without echo are points at (0, 0, 0), class 0
  unsigned threads = 1;               ///< 0 counts as 1; the bytes do not depend on it
};

/// Casts every beam of one scan. The same arguments give the same bytes.
SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       const Frame& pose, std::uint64_t seed, const ScanOptions& options = {});

}  // namespace flagstone::sim

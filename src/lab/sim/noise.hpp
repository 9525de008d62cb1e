// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "flagstone/sensor.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// How a measurement differs from the truth. The sensor's own range accuracy stands in Sensor.
struct Noise {
  /// Multiplies the sensor's range_sigma; 0 measures exactly.
  double range_sigma_scale = 1;

  /// Share of echoes lost for no reason of range or surface, 0..1.
  double drop_rate = 0.03;

  /// Strength of an echo that is detected half of the time: reflectivity * cos(incidence) /
  /// range^2, in 1/m^2; 0 detects everything. The default loses asphalt at about 50 m at 1.73 m
  /// height.
  double half_detection = 2.5e-6;

  /// Chance that a beam that meets the ground 1 m away returns by way of what its mirror image
  /// hits, so that the point lies below the ground; falls with the square of the range to the
  /// ground. 0..1.
  double ghost_rate = 0.1;

  /// Longest path of a ghost by way of the ground, metres.
  double ghost_max_range = 12;

  /// Standard deviation of the intensity, which runs from 0 to 1.
  double intensity_sigma = 0.03;

  /// Multiplies how well glass, still water and the like mirror, Surface::mirror; 0..1. A beam that
  /// is mirrored returns, if at all, as a ghost behind the mirror.
  double mirroring = 1;

  /// How well roads and pavements mirror for being wet, 0..1; wet ones are darker, by half at 1.
  double wetness = 0;

  /// Share of the beams on an edge between something near and something farther that are reported
  /// between the two, 0..1.
  double mixed_rate = 0;

  /// Angle that the light of a beam fills, radians: how near to an edge is on it.
  double beam_width = 0.003;

  /// Share of the beams that a drop of rain sends back, if they go as far as that, 0..1.
  double rain_rate = 0;

  /// Light lost in rain, 1/m, on the way there and on the way back.
  double rain_extinction = 0;

  /// Clouds of dust about the vehicle: the first behind it, the others within 25 m, 1.5 to 4 m in
  /// radius.
  int dust_clouds = 0;

  /// Light lost in the middle of a cloud, 1/m, less towards its rim; on the way there, what is lost
  /// is sent back.
  double dust_extinction = 0;

  /// Share of the beams with a range made up by another sensor's light, in bursts of firings in a
  /// row, 0..1.
  double crosstalk_rate = 0;

  /// Share of the beams lost in blocks: some degrees of a quarter of the rows; 0..1.
  double block_loss_rate = 0;
};

/// Exact ranges, nothing lost, no ghosts.
constexpr Noise no_noise() noexcept {
  return {.range_sigma_scale = 0,
          .drop_rate = 0,
          .half_detection = 0,
          .ghost_rate = 0,
          .ghost_max_range = 0,
          .intensity_sigma = 0,
          .mirroring = 0};
}

/// Is an echo of this strength reported? `range` in metres, `incidence` as a cosine.
bool is_detected(const Noise& noise, double range, double reflectivity, double incidence,
                 Random& random);

/// The range the sensor reports for an echo at `range`, metres.
double measured_range(const Noise& noise, const Sensor& sensor, double range, Random& random);

/// The intensity the sensor reports, 0..1. Beams are corrected for range, as the HDL-64E's firmware
/// does, not for incidence.
double measured_intensity(const Noise& noise, double reflectivity, double incidence,
                          Random& random);

/// Does a beam that meets the ground at `range` metres return by way of its mirror image, if that
/// hits something near enough?
bool is_mirrored(const Noise& noise, double range, Random& random);

/// A sensor's own noise by name.
struct NoiseLevel {
  std::string_view name;
  std::string_view summary;  ///< a line for a list
  Noise noise;
};

/// clean, default, harsh. The default is Noise{}.
std::span<const NoiseLevel> noise_levels() noexcept;

/// The level of this name; null if there is none.
const NoiseLevel* find_noise_level(std::string_view name) noexcept;

/// A kind of weather by name, which comes on top of the sensor's own noise.
struct Weather {
  std::string_view name;
  std::string_view summary;  ///< a line for a list
  void (*add_to)(Noise& noise);
};

/// clear, rain, dust, wet.
std::span<const Weather> weathers() noexcept;

/// The weather of this name; null if there is none.
const Weather* find_weather(std::string_view name) noexcept;

}  // namespace flagstone::sim

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "flagstone/sensor.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// How a measurement differs from the true range and reflectivity. The range accuracy of a sensor
/// is in Sensor.
struct Noise {
  /// Factor for the range_sigma of the sensor; 0 measures exactly.
  double range_sigma_scale = 1;

  /// Fraction of returns lost independently of range and surface, 0..1.
  double drop_rate = 0.03;

  /// Strength of a return that is detected half of the time: reflectivity * cos(incidence) /
  /// range^2, in 1/m^2; 0 detects everything. With the default, asphalt is lost at about 50 m from
  /// a sensor 1.73 m high.
  double half_detection = 2.5e-6;

  /// Probability, 0..1, that a beam which meets the ground 1 m away is reflected to an object and
  /// returns the same way: a ghost point below the ground. Decreases with the square of the range
  /// to the ground.
  double ghost_rate = 0.1;

  /// Maximum path length to a ghost point by way of the ground, metres.
  double ghost_max_range = 12;

  /// Standard deviation of the intensity, which ranges from 0 to 1.
  double intensity_sigma = 0.03;

  /// Factor, 0..1, for `Surface::mirror`: the specular reflection of glass, still water and similar
  /// surfaces. A reflected beam returns, if at all, as a ghost point behind the surface.
  double mirroring = 1;

  /// Specular reflection of wet roads and pavements, 0..1. They are also darker, by half at 1.
  double wetness = 0;

  /// Fraction of the beams at an edge between a near and a far surface that are reported between
  /// the two, 0..1.
  double mixed_rate = 0;

  /// Divergence of a beam, radians: a beam is at an edge if the edge is within this angle.
  double beam_width = 0.003;

  /// Fraction of the beams that a raindrop returns, if they reach as far as the drop, 0..1.
  double rain_rate = 0;

  /// Extinction of light in rain, 1/m, on the outward and the return path.
  double rain_extinction = 0;

  /// Number of dust clouds, 1.5 to 4 m in radius: the first behind the vehicle, the others within
  /// 25 m.
  int dust_clouds = 0;

  /// Extinction in the middle of a dust cloud, 1/m, decreasing towards its rim. Light lost on the
  /// outward path is returned to the sensor.
  double dust_extinction = 0;

  /// Fraction of the beams with a false range from the light of another sensor, 0..1. They come in
  /// bursts of consecutive firings.
  double crosstalk_rate = 0;

  /// Fraction of the beams lost in blocks, 0..1. A block is some degrees of a quarter of the rows.
  double block_loss_rate = 0;
};

/// Exact ranges, no lost returns, no ghost points.
constexpr Noise no_noise() noexcept {
  return {.range_sigma_scale = 0,
          .drop_rate = 0,
          .half_detection = 0,
          .ghost_rate = 0,
          .ghost_max_range = 0,
          .intensity_sigma = 0,
          .mirroring = 0};
}

/// Whether a return of this strength is reported. `range` in metres, `incidence` as a cosine.
bool is_detected(const Noise& noise, double range, double reflectivity, double incidence,
                 Random& random);

/// The range that the sensor reports for a return at `range`, metres.
double measured_range(const Noise& noise, const Sensor& sensor, double range, Random& random);

/// The intensity that the sensor reports, 0..1. It is corrected for range, as in the firmware of
/// the HDL-64E, but not for incidence.
double measured_intensity(const Noise& noise, double reflectivity, double incidence,
                          Random& random);

/// Whether a beam that meets the ground at `range` metres is reflected specularly. It then returns
/// if the reflected beam hits an object near enough.
bool is_mirrored(const Noise& noise, double range, Random& random);

/// A named level of sensor noise.
struct NoiseLevel {
  std::string_view name;
  std::string_view summary;  ///< one line for a list
  Noise noise;
};

/// The levels clean, default (Noise{}) and harsh.
std::span<const NoiseLevel> noise_levels() noexcept;

/// The level of this name; null if there is none.
const NoiseLevel* find_noise_level(std::string_view name) noexcept;

/// A named kind of weather, which adds to the noise of the sensor.
struct Weather {
  std::string_view name;
  std::string_view summary;  ///< one line for a list
  void (*add_to)(Noise& noise);
};

/// The kinds clear, rain, dust and wet.
std::span<const Weather> weathers() noexcept;

/// The weather of this name; null if there is none.
const Weather* find_weather(std::string_view name) noexcept;

}  // namespace flagstone::sim

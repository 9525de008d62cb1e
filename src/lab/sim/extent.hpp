// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Number of frames of one stretch at the default pace.
inline constexpr int frames_per_drive = 10;

/// Distance between frames, metres: far enough that the scans of a run differ.
inline constexpr double frame_spacing = 8;

/// Half of the length of a stretch, metres: the first one is from x = -half_drive to half_drive.
inline constexpr double half_drive = (frames_per_drive - 1) * frame_spacing / 2;

/// Length of a stretch of an environment, metres.
inline constexpr double stretch_length = 2 * half_drive;

/// Number of stops of the sensor on its way through one stretch, without the first one.
inline constexpr int stops_per_stretch = frames_per_drive - 1;

/// A part of an environment, in road coordinates. By default, the whole of the shortest one.
struct Stretch {
  std::size_t index = 0;
  Interval x{-half_drive, half_drive};
  bool at_begin = true, at_end = true;  ///< whether it is at an end of an open environment

  /// The part of the x axis to fill: up to `beyond` metres beyond the ends of the environment, but
  /// `within` metres less than the stretch towards its neighbours.
  [[nodiscard]] Interval reach(double beyond, double within = 0) const noexcept {
    return {at_begin ? x.low - beyond : x.low + within, at_end ? x.high + beyond : x.high - within};
  }

  /// `random` for the first stretch, and an independent stream for every other one.
  [[nodiscard]] Random stream(Random random) const noexcept {
    return index == 0 ? random : Random::stream(random.bits(), index);
  }
};

/// Length and form of an environment, in road coordinates: x is along the road, from begin() to
/// end(). All lengths in metres.
struct Extent {
  std::size_t stretches = 1;
  bool closed =
      false;  ///< a circuit, which a run passes twice: end() is the same position as begin()

  [[nodiscard]] bool is_long() const noexcept { return stretches > 1; }
  [[nodiscard]] double length() const noexcept {
    return static_cast<double>(stretches) * stretch_length;
  }
  [[nodiscard]] double begin() const noexcept { return -half_drive; }
  [[nodiscard]] double end() const noexcept { return begin() + length(); }

  /// The environment, up to `beyond` metres beyond its ends. A circuit has no ends; `within` metres
  /// on either side of the joint that closes it are omitted.
  [[nodiscard]] Interval reach(double beyond, double within = 0) const noexcept {
    return closed ? Interval{begin() + within, end() - within}
                  : Interval{begin() - beyond, end() + beyond};
  }

  [[nodiscard]] Stretch stretch(std::size_t index) const noexcept {
    const double low = begin() + static_cast<double>(index) * stretch_length;
    return {.index = index,
            .x = {low, low + stretch_length},
            .at_begin = !closed && index == 0,
            .at_end = !closed && index + 1 == stretches};
  }

  /// @name The run through the environment. On a circuit, x increases from lap to lap
  /// @{
  [[nodiscard]] std::size_t stretches_of_run() const noexcept {
    return closed ? 2 * stretches : stretches;
  }
  [[nodiscard]] Interval run(double beyond) const noexcept {
    const auto passed = static_cast<double>(stretches_of_run());
    return {begin() - beyond, begin() + passed * stretch_length + beyond};
  }
  /// Number of the stretch of the run at x.
  [[nodiscard]] std::size_t stretch_at(double x) const noexcept {
    const auto last = static_cast<double>(stretches_of_run() - 1);
    return static_cast<std::size_t>(
        std::clamp(std::floor((x - begin()) / stretch_length), 0.0, last));
  }
  /// Positions on the environment, on every lap.
  [[nodiscard]] std::vector<double> each_lap(const std::vector<double>& places) const {
    std::vector<double> all = places;
    if (closed) {
      for (const double x : places) all.push_back(x + length());
    }
    return all;
  }
  /// Distance at which things that move are simulated. The shortest environment shows all of them.
  [[nodiscard]] double view() const noexcept {
    return is_long() ? 200 : std::numeric_limits<double>::infinity();
  }
  /// @}

  /// The nearest wave number (rad/m) with which a wave closes on the circuit.
  [[nodiscard]] double fitted(double wave_number) const noexcept {
    if (!closed) return wave_number;
    const double once = 2 * std::numbers::pi / length();
    return std::round(wave_number / once) * once;
  }
  /// The nearest wavelength with which a wave closes on the circuit.
  [[nodiscard]] double fitted_length(double wavelength) const noexcept {
    return closed ? length() / std::max(1.0, std::round(length() / wavelength)) : wavelength;
  }

  friend bool operator==(const Extent&, const Extent&) = default;
};

/// A number of objects in an interval: `count` in `metres` metres.
inline int count_of(int count, double metres, Interval in) noexcept {
  return static_cast<int>(count * (in.high - in.low) / metres);
}

}  // namespace flagstone::sim

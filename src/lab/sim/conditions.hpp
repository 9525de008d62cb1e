// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "lab/sim/noise.hpp"

namespace flagstone::sim {

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

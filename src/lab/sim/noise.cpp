// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/noise.hpp"

#include <algorithm>
#include <array>

namespace flagstone::sim {

bool is_detected(const Noise& noise, double range, double reflectivity, double incidence,
                 Random& random) {
  const double strength = reflectivity * incidence / (range * range);
  // A smooth step on a logarithmic scale, without computing a logarithm.
  const double detection =
      noise.half_detection == 0
          ? 1
          : strength * strength /
                (strength * strength + noise.half_detection * noise.half_detection);
  return random.chance(detection * (1 - noise.drop_rate));
}

double measured_range(const Noise& noise, const Sensor& sensor, double range, Random& random) {
  return range + noise.range_sigma_scale * sensor.range_sigma * random.normal();
}

double measured_intensity(const Noise& noise, double reflectivity, double incidence,
                          Random& random) {
  constexpr double diffuse_share = 0.4;  // fraction lost at grazing incidence
  const double returned = reflectivity * (1 - diffuse_share * (1 - incidence));
  return std::clamp(returned + noise.intensity_sigma * random.normal(), 0.0, 1.0);
}

bool is_mirrored(const Noise& noise, double range, Random& random) {
  return range < noise.ghost_max_range && random.chance(noise.ghost_rate / (range * range));
}

namespace {

constexpr double wet_road = 0.4;

constexpr std::array levels{
    NoiseLevel{.name = "clean",
               .summary = "exact ranges, no lost returns, no ghost points",
               .noise = no_noise()},
    NoiseLevel{.name = "default",
               .summary = "range noise, lost weak returns, few ghost points, reflective glass",
               .noise = {}},
    NoiseLevel{.name = "harsh",
               .summary = "also mixed pixels at edges, bursts of crosstalk, lost blocks",
               .noise = {.mixed_rate = 0.5, .crosstalk_rate = 0.002, .block_loss_rate = 0.02}},
};

constexpr std::array kinds{
    Weather{.name = "clear", .summary = "dry, no dust", .add_to = [](Noise&) {}},
    Weather{.name = "rain",
            .summary = "raindrops, weaker returns, wet roads",
            .add_to =
                [](Noise& noise) {
                  noise.rain_rate = 0.02;
                  noise.rain_extinction = 0.005;
                  noise.wetness = wet_road;
                }},
    Weather{.name = "dust",
            .summary = "dust clouds around and behind the vehicle",
            .add_to =
                [](Noise& noise) {
                  noise.dust_clouds = 8;
                  noise.dust_extinction = 0.3;
                }},
    Weather{.name = "wet",
            .summary = "wet roads: dark and reflective, with ghost points below",
            .add_to = [](Noise& noise) { noise.wetness = wet_road; }},
};

}  // namespace

std::span<const NoiseLevel> noise_levels() noexcept { return levels; }

const NoiseLevel* find_noise_level(std::string_view name) noexcept {
  const auto* found = std::ranges::find(levels, name, &NoiseLevel::name);
  return found == levels.end() ? nullptr : found;
}

std::span<const Weather> weathers() noexcept { return kinds; }

const Weather* find_weather(std::string_view name) noexcept {
  const auto* found = std::ranges::find(kinds, name, &Weather::name);
  return found == kinds.end() ? nullptr : found;
}

}  // namespace flagstone::sim

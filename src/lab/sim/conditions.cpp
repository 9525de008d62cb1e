// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/conditions.hpp"

#include <algorithm>
#include <array>

namespace flagstone::sim {
namespace {

constexpr double wet_road = 0.4;

constexpr std::array levels{
    NoiseLevel{
        .name = "clean", .summary = "exact ranges, nothing lost, no ghosts", .noise = no_noise()},
    NoiseLevel{.name = "default",
               .summary = "range noise, weak echoes lost, few ghosts, mirroring glass",
               .noise = {}},
    NoiseLevel{.name = "harsh",
               .summary = "also mixed pixels at edges, crosstalk bursts, blocks lost",
               .noise = {.mixed_rate = 0.5, .crosstalk_rate = 0.002, .block_loss_rate = 0.02}},
};

constexpr std::array kinds{
    Weather{.name = "clear", .summary = "dry, no dust", .add_to = [](Noise&) {}},
    Weather{.name = "rain",
            .summary = "drops in the air, weaker echoes, wet roads",
            .add_to =
                [](Noise& noise) {
                  noise.rain_rate = 0.02;
                  noise.rain_extinction = 0.005;
                  noise.wetness = wet_road;
                }},
    Weather{.name = "dust",
            .summary = "clouds of dust about and behind the vehicle",
            .add_to =
                [](Noise& noise) {
                  noise.dust_clouds = 8;
                  noise.dust_extinction = 0.3;
                }},
    Weather{.name = "wet",
            .summary = "roads that mirror: dark, with ghosts below",
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

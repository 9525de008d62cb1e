// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/mount_options.hpp"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/config/config_toml.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone::cli {
namespace {

std::optional<float> number_of(std::string_view text) {
  float number = 0;
  const char* const begin = std::to_address(text.begin());
  const char* const end = std::to_address(text.end());
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest != end) return {};
  return number;
}

/// "0,0.17,0.98"
std::optional<std::array<float, 3>> direction_of(std::string_view text) {
  std::array<float, 3> direction{};
  for (std::size_t i = 0; i < direction.size(); ++i) {
    const std::size_t comma = text.find(',');
    const bool is_last = i + 1 == direction.size();
    if ((comma == std::string_view::npos) != is_last) return {};
    const auto number = number_of(text.substr(0, comma));
    if (!number) return {};
    direction[i] = *number;
    if (!is_last) text.remove_prefix(comma + 1);
  }
  return direction;
}

}  // namespace

void MountOptions::add_to(CLI::App& command) {
  const auto read_height = [this](const std::string& text) {
    if (text == to_string(HeightSource::estimate)) {
      height = HeightSource::estimate;
    } else if (text == to_string(HeightSource::track)) {
      height = HeightSource::track;
    } else if (const auto number = number_of(text)) {
      sensor_height = number;
      height = HeightSource::fixed;
    } else {
      throw CLI::ValidationError("--sensor-height",
                                 fmt::format("{} is no number of metres, estimate or track", text));
    }
  };
  command
      .add_option_function<std::string>(
          "--sensor-height", read_height,
          "Height of the sensor above ground: metres; estimate, from the first scan that tells it; "
          "track, from every scan, smoothed")
      ->type_name("M|estimate|track");
  const auto read_tilt = [this](const std::string& text) {
    if (text == to_string(TiltSource::off)) {
      tilt = TiltSource::off;
    } else if (text == to_string(TiltSource::estimate)) {
      tilt = TiltSource::estimate;
    } else if (const auto direction = direction_of(text)) {
      tilt = TiltSource::fixed;
      up = direction;
    } else {
      throw CLI::ValidationError(
          "--tilt", fmt::format("{} is not off, estimate or where up is, X,Y,Z", text));
    }
  };
  command
      .add_option_function<std::string>(
          "--tilt", read_tilt,
          "Where up is for a sensor that leans: X,Y,Z in its frame, such as minus an IMU's "
          "gravity; "
          "estimate, from scans as the height; off, along z. Default: off")
      ->type_name("off|estimate|X,Y,Z");
}

void MountOptions::apply_to(MethodConfig& config, MountSettings& settings) const {
  if (sensor_height) config::set_sensor_height(*sensor_height, config);
  settings.mount.sensor_height =
      sensor_height_of(config, sensor_height.value_or(settings.mount.sensor_height));
  if (height) settings.height = *height;
  if (tilt) settings.tilt = *tilt;
  if (up) settings.mount.up = *up;
}

}  // namespace flagstone::cli

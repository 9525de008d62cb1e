// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "method.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "app/config/config_file.hpp"
#include "app/config/config_toml.hpp"
#include "app/config/sensor_settings.hpp"
#include "files/io/sensor_file.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone::python {
namespace {

std::optional<Sensor> chosen_sensor(const MethodChoice& choice) {
  const std::optional<std::string> in_file = config::sensor_named_in_file(choice.config_file);
  if (choice.sensor.empty() && !in_file) return std::nullopt;
  if (!choice.sensor.empty() && in_file) {
    throw std::invalid_argument(fmt::format("sensor={:?}: {} names a sensor too; give one of them",
                                            choice.sensor, choice.config_file));
  }
  if (choice.preset != "default") {
    throw std::invalid_argument(fmt::format(
        "a sensor beside preset={:?}: settings start from one or the other", choice.preset));
  }
  Sensor sensor;
  const Status status = io::find_sensor(in_file ? *in_file : choice.sensor, sensor);
  if (!status.ok()) throw std::invalid_argument("sensor: " + status.message());
  return sensor;
}

void apply_height(const MethodChoice& choice, MethodConfig& config, MountSettings& mount) {
  float otherwise = mount.mount.sensor_height;
  if (const auto* metres = std::get_if<float>(&choice.sensor_height)) {
    config::set_sensor_height(*metres, config);
    mount.height = HeightSource::fixed;
    otherwise = *metres;
  } else if (const auto* word = std::get_if<std::string>(&choice.sensor_height)) {
    if (*word != "estimate" && *word != "track") {
      throw std::invalid_argument(fmt::format(
          "sensor_height = {:?} is neither metres nor \"estimate\" nor \"track\"", *word));
    }
    mount.height = *word == "track" ? HeightSource::track : HeightSource::estimate;
  }
  mount.mount.sensor_height = sensor_height_of(config, otherwise);
}

void apply_tilt(const MethodChoice& choice, MountSettings& mount) {
  if (const auto* up = std::get_if<std::array<float, 3>>(&choice.tilt)) {
    mount.tilt = TiltSource::fixed;
    mount.mount.up = *up;
  } else if (const auto* word = std::get_if<std::string>(&choice.tilt)) {
    if (*word != "estimate" && *word != "off") {
      throw std::invalid_argument(fmt::format(
          "tilt = {:?} is neither \"off\" nor \"estimate\" nor where up is, (x, y, z)", *word));
    }
    mount.tilt = *word == "off" ? TiltSource::off : TiltSource::estimate;
  }
}

MethodConfig overlaid(const MethodChoice& choice, MethodConfig config, MountSettings& mount) {
  mount = {};
  if (!choice.config_file.empty()) config::apply_file(choice.config_file, config, mount);
  config::apply_toml(choice.settings, "", config, mount);
  apply_height(choice, config, mount);
  apply_tilt(choice, mount);
  return config;
}

}  // namespace

MethodConfig resolve(const MethodChoice& choice, MountSettings& mount) {
  const bool has_presets = choice.method == "patchwork" || choice.method.starts_with("czm");
  if (!has_presets && choice.preset != "default") {
    throw std::invalid_argument(
        fmt::format("preset = {:?}: method {} has none; presets are of patchwork and czm+...",
                    choice.preset, choice.method));
  }
  const std::optional<Sensor> sensor = chosen_sensor(choice);
  const auto settings_at = [&](const Sensor& at) {
    return overlaid(choice, default_config(choice.method, at), mount);
  };
  MethodConfig config =
      sensor
          ? config::settings_at_own_height(*sensor, settings_at)
          : overlaid(choice, default_config(choice.method, PatchworkConfig::preset(choice.preset)),
                     mount);
  check(config);
  mount.check();
  return config;
}

std::unique_ptr<Segmenter> make_method(const std::string& name, const MethodConfig& config,
                                       unsigned threads) {
  if (name == "patchwork") {
    return std::make_unique<Patchwork>(std::get<PatchworkConfig>(config), threads);
  }
  if (name == "surface") {
    return std::make_unique<Surface>(std::get<SurfaceConfig>(config), threads);
  }
  if (threads != 1) {
    throw std::invalid_argument(fmt::format(
        "threads = {}: method {} has one; surface and patchwork have more", threads, name));
  }
  return make_segmenter(name, config);
}

}  // namespace flagstone::python

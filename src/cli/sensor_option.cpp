// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sensor_option.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "baselines/settings.hpp"
#include "cli/config_toml.hpp"
#include "io/load_bytes.hpp"
#include "io/sensor_file.hpp"

namespace flagstone::cli {
namespace {

std::optional<std::string> sensor_in_file(const std::string& config_file) {
  if (config_file.empty()) return std::nullopt;
  std::vector<std::byte> bytes;
  const Status status = io::load_bytes(config_file, bytes);
  if (!status.ok()) throw std::invalid_argument(status.message());
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::optional<std::string> named = sensor_named_in(text, config_file);
  const bool is_file = named && std::filesystem::path(*named).extension() == ".toml";
  if (is_file) named = (std::filesystem::path(config_file).parent_path() / *named).string();
  return named;
}

}  // namespace

CLI::Option* add_sensor_option(CLI::App& command, std::string& sensor) {
  return command
      .add_option("--sensor", sensor,
                  "Derive settings from this sensor: a name that 'flagstone sensors' lists, or a "
                  ".toml file of your own")
      ->type_name("NAME|FILE");
}

std::optional<Sensor> chosen_sensor(const std::string& option, const std::string& config_file,
                                    const std::string& preset) {
  const std::optional<std::string> in_file = sensor_in_file(config_file);
  if (option.empty() && !in_file) return std::nullopt;
  if (!option.empty() && in_file) {
    throw std::invalid_argument(
        fmt::format("--sensor {}: {} names a sensor too; give one of them", option, config_file));
  }
  const std::string origin = in_file ? config_file + ": sensor" : "--sensor";
  if (preset != "default") {
    throw std::invalid_argument(
        fmt::format("{} beside --preset {}: settings start from one or the other", origin, preset));
  }
  Sensor sensor;
  const Status status = io::find_sensor(in_file ? *in_file : option, sensor);
  if (!status.ok()) throw std::invalid_argument(fmt::format("{}: {}", origin, status.message()));
  return sensor;
}

void refuse_sensor_in_setting(const std::string& setting, const std::string& source) {
  if (!sensor_named_in(setting, source)) return;
  throw std::invalid_argument(
      fmt::format("{}: a sensor is named by --sensor, or at the top of a --config file", source));
}

MethodConfig settings_at_own_height(Sensor sensor,
                                    const std::function<MethodConfig(const Sensor&)>& settings_at) {
  MethodConfig config = settings_at(sensor);
  const auto usual = static_cast<float>(sensor.height);
  const float height = sensor_height_of(config, usual);
  // At 0 and below the frame's origin is not in the sensor; its own height is the better guess.
  if (height == usual || !(height > 0)) return config;
  sensor.height = height;
  return settings_at(sensor);
}

}  // namespace flagstone::cli

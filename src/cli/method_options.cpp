// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/method_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "library/core/did_you_mean.hpp"

namespace flagstone::cli {
namespace {

void add_set_option(CLI::App& command, config::MethodChoice& choice, const char* type,
                    const char* meaning, config::GivenSettings (*parse)(const std::string&)) {
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&choice, parse](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) choice.settings.push_back(parse(text));
          },
          meaning)
      ->type_name(type)
      ->allow_extra_args(false);
}

void add_preset_and_sensor_options(CLI::App& command, config::MethodChoice& choice) {
  const auto presets = PatchworkConfig::preset_names();
  command
      .add_option("--preset", choice.preset,
                  fmt::format("With patchwork and czm+...: settings to start from: {}",
                              fmt::join(presets, ", ")))
      ->capture_default_str()
      ->type_name("NAME");
  command
      .add_option("--sensor", choice.sensor,
                  "Derive settings from this sensor: a name that 'flagstone sensors' lists, or a "
                  ".toml file of your own")
      ->type_name("NAME|FILE");
}

/// A `read` that throws std::invalid_argument, as a function of an option.
template <class Read>
auto reader(const char* option, Read read) {
  return [option, read](const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(option, error.what());
    }
  };
}

void add_mount_options(CLI::App& command, config::MountChoice& mount) {
  command
      .add_option_function<std::string>(
          "--sensor-height",
          reader("--sensor-height", [&](const std::string& text) { mount.set_height(text); }),
          "Height of the sensor above ground: metres; estimate, from the first scan that tells it; "
          "track, from every scan, smoothed")
      ->type_name("M|estimate|track");
  command
      .add_option_function<std::string>(
          "--tilt", reader("--tilt", [&](const std::string& text) { mount.set_tilt(text); }),
          "Up direction of a tilted sensor: X,Y,Z in the sensor frame, such as the negated gravity "
          "of an IMU; estimate, from scans as the height; off, along z. Default: off")
      ->type_name("off|estimate|X,Y,Z");
}

}  // namespace

void add_method_options(CLI::App& command, config::MethodChoice& choice,
                        std::span<const std::string_view> names) {
  const std::vector<std::string_view> known(names.begin(), names.end());
  command
      .add_option_function<std::string>(
          "--method",
          [&choice, known](const std::string& name) {
            if (std::ranges::find(known, name) == known.end()) {
              throw CLI::ValidationError("--method", no_such("method", name, known));
            }
            choice.methods = {name};
          },
          fmt::format("How to segment: {}", fmt::join(names, ", ")))
      ->default_str(choice.methods.front())
      ->type_name("NAME");
  add_preset_and_sensor_options(command, choice);
  command
      .add_option("--config", choice.config_file,
                  "TOML file of settings, as 'flagstone config' prints")
      ->type_name("FILE");
  add_set_option(command, choice, "KEY=VALUE",
                 "One setting, e.g. --set elevation.enabled=false; may repeat",
                 config::parse_setting);
  add_mount_options(command, choice.mount);
}

void add_methods_options(CLI::App& command, config::MethodChoice& choice) {
  command
      .add_option(
          "--methods", choice.methods,
          fmt::format("What to evaluate, in this order: {}; table1: the nine of the paper's "
                      "Table I; all; none",
                      fmt::join(config::method_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->type_name("LIST");
  add_preset_and_sensor_options(command, choice);
  command
      .add_option("--config", choice.config_file,
                  "TOML file of settings, as 'flagstone config' prints, for each of the methods "
                  "that has all of them")
      ->type_name("FILE");
  add_set_option(
      command, choice, "METHOD.KEY=VALUE",
      "One setting of one method, e.g. --set gpf.segments=5; those of patchwork hold for "
      "the rows CZM + ... too; may repeat",
      config::parse_setting_of_method);
  add_mount_options(command, choice.mount);
}

}  // namespace flagstone::cli

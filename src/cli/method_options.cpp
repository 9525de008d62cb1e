// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/method_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/help.hpp"
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
      ->allow_extra_args(false)
      ->group(method_group);
}

void add_preset_and_sensor_options(CLI::App& command, config::MethodChoice& choice) {
  const auto presets = PatchworkConfig::preset_names();
  command
      .add_option(
          "--preset", choice.preset,
          fmt::format("Preset for patchwork and czm+...: one of {}", fmt::join(presets, ", ")))
      ->capture_default_str()
      ->type_name("NAME")
      ->group(method_group);
  command
      .add_option("--sensor", choice.sensor,
                  "Derive settings from a sensor: a name from 'flagstone sensors', or a TOML file")
      ->type_name("NAME|FILE")
      ->group(method_group);
}

/// Turns the std::invalid_argument of `read` into a usage error of the option.
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
          "Height of the sensor above the ground: a value in metres; 'estimate' to use the first "
          "scan that determines it; 'track' to update it with every scan")
      ->type_name("M|estimate|track")
      ->group(method_group);
  command
      .add_option_function<std::string>(
          "--tilt", reader("--tilt", [&](const std::string& text) { mount.set_tilt(text); }),
          "Up direction of a tilted sensor: 'off' for z up; 'estimate' to determine it from the "
          "scans; X,Y,Z in the sensor frame, e.g. the negated gravity vector of an IMU")
      ->default_str("off")
      ->type_name("off|estimate|X,Y,Z")
      ->group(method_group);
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
          fmt::format("Segmentation method: one of {}", fmt::join(names, ", ")))
      ->default_str(choice.methods.front())
      ->type_name("NAME")
      ->group(method_group);
  add_preset_and_sensor_options(command, choice);
  command
      .add_option("--config", choice.config_file,
                  "Read settings from a TOML file; 'flagstone config' prints a template")
      ->type_name("FILE")
      ->group(method_group);
  add_set_option(command, choice, "KEY=VALUE",
                 "Override one setting, e.g. --set elevation.enabled=false", config::parse_setting);
  add_mount_options(command, choice.mount);
}

void add_methods_options(CLI::App& command, config::MethodChoice& choice) {
  command
      .add_option("--methods", choice.methods,
                  fmt::format("Methods to evaluate, in this order, separated by commas: names; "
                              "'table1', the nine of Table I of the Patchwork paper; 'all'; "
                              "'none'. Names: {}",
                              fmt::join(config::method_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str(fmt::format("{}", fmt::join(choice.methods, ",")))
      ->type_name("LIST")
      ->group(method_group);
  add_preset_and_sensor_options(command, choice);
  command
      .add_option("--config", choice.config_file,
                  "Read settings from a TOML file; they apply to each method that has all of them")
      ->type_name("FILE")
      ->group(method_group);
  add_set_option(command, choice, "METHOD.KEY=VALUE",
                 "Override one setting of one method, e.g. --set gpf.segments=5; settings of "
                 "patchwork also apply to czm+...",
                 config::parse_setting_of_method);
  add_mount_options(command, choice.mount);
}

}  // namespace flagstone::cli

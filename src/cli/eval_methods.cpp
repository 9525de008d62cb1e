// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/eval_methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/config/config_file.hpp"
#include "app/config/config_toml.hpp"
#include "app/config/sensor_settings.hpp"
#include "cli/method_options.hpp"
#include "cli/sensor_option.hpp"

namespace flagstone::cli {
namespace {

/// The nine rows of the paper's Table I.
bool is_in_table_1(std::string_view name) { return name != "patchwork" && name != "surface"; }

std::vector<std::string> expanded(const std::vector<std::string>& listed) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name) {
    if (std::ranges::find(names, name) == names.end()) names.emplace_back(name);
  };
  for (const std::string& entry : listed) {
    if (entry == "none") continue;
    if (entry != "all" && entry != "table1") add(entry);
    for (const std::string_view name : method_names()) {
      if (entry == "all" || (entry == "table1" && is_in_table_1(name))) add(name);
    }
  }
  return names;
}

/// "gpf.segments=5" is a setting of method gpf.
std::pair<std::string, std::string> split_setting(const std::string& setting) {
  const std::size_t dot = setting.find('.');
  const std::string method = setting.substr(0, std::min(dot, setting.size()));
  const auto names = method_names();
  if (dot == std::string::npos || std::ranges::find(names, method) == names.end()) {
    throw std::invalid_argument(
        fmt::format("--set {}: begins with a method and a dot, e.g. --set gpf.segments=5; methods "
                    "are {}",
                    setting, fmt::join(names, ", ")));
  }
  return {method, setting.substr(dot + 1)};
}

/// Do the settings of this method start from Patchwork's?
bool starts_from_patchwork(std::string_view method) {
  return method == "patchwork" || method.starts_with("czm");
}

eval::Method labels_made_elsewhere(const std::string& entry, io::LabelMap map) {
  const std::size_t equals = entry.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == entry.size()) {
    throw std::invalid_argument(
        fmt::format("--labels {}: allowed: NAME=DIR, e.g. --labels other=out/other", entry));
  }
  eval::Method method;
  method.name = entry.substr(0, equals);
  method.title = method.name;
  method.labels = entry.substr(equals + 1);
  method.label_map = map;
  if (!std::filesystem::is_directory(method.labels)) {
    throw std::invalid_argument(
        fmt::format("--labels {}: {}: no such folder", entry, method.labels.string()));
  }
  return method;
}

}  // namespace

void EvalMethods::add_to(CLI::App& command) {
  command
      .add_option(
          "--methods", names,
          fmt::format("What to evaluate, in this order: {}; table1: the nine of the paper's "
                      "Table I; all; none",
                      fmt::join(method_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str()
      ->type_name("LIST");
  add_preset_option(command, preset)
      ->description("Patchwork's settings to start from, for the rows CZM + ... too");
  add_sensor_option(command, sensor);
  command
      .add_option("--config", config_file,
                  "TOML file of Patchwork's settings, as 'flagstone config' prints")
      ->type_name("FILE");
  command
      .add_option(
          "--set", settings,
          "One setting of one method, e.g. --set gpf.segments=5; those of patchwork hold for "
          "the rows CZM + ... too; may repeat")
      ->type_name("METHOD.KEY=VALUE")
      ->allow_extra_args(false);
  mount.add_to(command);
  command
      .add_option("--labels", labels,
                  "Labels that another program made, scored like a method: NAME.label, NAME.npy or "
                  "NAME.label.npy of each scan, one code a point, 1 for ground; may repeat")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  const std::map<std::string, io::LabelMap> maps = {
      {"flagstone", io::LabelMap::flagstone}, {"semantic-kitti", io::LabelMap::semantic_kitti}};
  command
      .add_option("--label-map", label_map,
                  "Codes in --labels: flagstone (1 is ground), or semantic-kitti (the classes that "
                  "the protocol takes for ground)")
      ->transform(CLI::Transformer(maps).description(""))
      ->transform(CLI::IsMember(maps));
}

std::vector<EvalMethods::OwnSetting> EvalMethods::own_settings() const {
  std::vector<OwnSetting> all;
  for (const std::string& setting : settings) {
    if (setting.starts_with("mount.")) continue;
    auto [method, rest] = split_setting(setting);
    refuse_sensor_in_setting(rest, fmt::format("--set {}", setting));
    all.push_back({std::move(method), std::move(rest)});
  }
  return all;
}

PatchworkConfig EvalMethods::overlaid(PatchworkConfig patchwork,
                                      MountSettings& mount_settings) const {
  MethodConfig config = std::move(patchwork);
  mount_settings = {};
  if (!config_file.empty()) config::apply_file(config_file, config, mount_settings);
  for (const std::string& setting : settings) {
    if (!setting.starts_with("mount.")) continue;
    config::apply_toml(setting, fmt::format("--set {}", setting), config, mount_settings);
  }
  for (const auto& [method, setting] : own_settings()) {
    if (method != "patchwork") continue;
    config::apply_toml(setting, fmt::format("--set patchwork.{}", setting), config);
  }
  return std::get<PatchworkConfig>(config);
}

MethodConfig EvalMethods::settings_of(const std::string& method, const std::optional<Sensor>& from,
                                      MountSettings& mount_settings) const {
  const auto settings_at = [&](const Sensor* at) {
    const bool from_patchwork = starts_from_patchwork(method);
    const PatchworkConfig patchwork =
        overlaid(at != nullptr && from_patchwork ? PatchworkConfig::for_sensor(*at)
                                                 : PatchworkConfig::preset(preset),
                 mount_settings);
    MethodConfig config = at != nullptr && !from_patchwork ? default_config(method, *at)
                                                           : default_config(method, patchwork);
    for (const auto& [owner, setting] : own_settings()) {
      if (owner != method || method == "patchwork") continue;
      config::apply_toml(setting, fmt::format("--set {}.{}", method, setting), config);
    }
    mount.apply_to(config, mount_settings);
    return config;
  };
  if (!from) return settings_at(nullptr);
  return config::settings_at_own_height(*from, [&](const Sensor& at) { return settings_at(&at); });
}

std::vector<eval::Method> EvalMethods::resolve() const {
  const std::optional<Sensor> from = chosen_sensor(sensor, config_file, preset);
  const std::vector<std::string> evaluated = expanded(names);
  bool sets_patchwork = false;
  for (const auto& [method, setting] : own_settings()) {
    sets_patchwork = sets_patchwork || method == "patchwork";
    if (method != "patchwork" && std::ranges::find(evaluated, method) == evaluated.end()) {
      throw std::invalid_argument(
          fmt::format("--set {}.{}: {} is not among --methods", method, setting, method));
    }
  }
  const bool are_given = preset != "default" || !config_file.empty() || sets_patchwork;
  if (are_given && std::ranges::none_of(evaluated, starts_from_patchwork)) {
    throw std::invalid_argument(
        "--preset, --config and --set patchwork...: are of patchwork and czm+..., and none of them "
        "is among --methods");
  }
  std::vector<eval::Method> methods;
  for (const std::string& name : evaluated) {
    MountSettings own_mount;
    MethodConfig config = settings_of(name, from, own_mount);
    own_mount.check();
    methods.push_back(eval::method_of(name, std::move(config), own_mount));
  }
  for (const std::string& entry : labels) {
    methods.push_back(labels_made_elsewhere(entry, label_map));
  }
  if (methods.empty())
    throw std::invalid_argument("no method to evaluate; see --methods, --labels");
  std::map<std::string, int> count;
  for (const eval::Method& method : methods) {
    if (++count[method.name] == 2) {
      throw std::invalid_argument(fmt::format("two methods are called {}", method.name));
    }
  }
  return methods;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/option_values.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "app/config/method_choice.hpp"
#include "cli/help.hpp"
#include "cli/shared_options.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/sensor.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/pose_noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone::cli {
namespace {

std::vector<std::string_view> parts_of(std::string_view text, std::string_view separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + separator.size());
  }
}

std::vector<std::string> names_of(const auto& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.emplace_back(thing.name);
  return names;
}

/// Methods that the help of the option lists: `bench` has only some of them.
std::vector<std::string> methods_of(const std::string& help) {
  std::vector<std::string> names;
  for (const std::string_view name : config::method_names()) {
    if (help.find(name) != std::string::npos) names.emplace_back(name);
  }
  return names;
}

/// The names that an option takes if they are not a table in its description.
std::vector<std::string> known_names(std::string_view option, const std::string& help) {
  if (option == "method") return methods_of(help);
  if (option == "methods") {
    std::vector<std::string> names = methods_of(help);
    names.insert(names.end(), {"table1", "all", "none"});
    return names;
  }
  if (option == "preset") {
    const auto presets = PatchworkConfig::preset_names();
    return {presets.begin(), presets.end()};
  }
  if (option == "sensor" || option == "sensors") return names_of(Sensor::known());
  if (option == "scene") return names_of(sim::scene_kinds());
  if (option == "noise") return names_of(sim::noise_levels());
  if (option == "weather") return names_of(sim::weathers());
  if (option == "pose-noise") return names_of(sim::pose_noises());
  if (option == "protocol") {
    std::vector<std::string> names;
    for (const eval::Protocol* const protocol : eval::known_protocols()) {
      names.push_back(protocol->name);
    }
    return names;
  }
  if (option == "isa") return simd_targets();
  if (option == "label-map") {
    std::vector<std::string> names;
    for (const auto& [name, map] : label_maps()) names.push_back(name);
    return names;
  }
  return {};
}

bool is_word(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= 'a' && c <= 'z'; });
}

}  // namespace

OptionValues values_of(const CLI::Option& option) {
  OptionValues values;
  if (option.get_items_expected_max() == 0) return values;
  const std::string& name =
      option.get_positional() ? option.get_name() : option.get_lnames().front();
  const OptionText text = text_of(option);
  for (const auto& [row, meaning] : text.names) {
    for (const std::string_view word : parts_of(row, ", ")) values.words.emplace_back(word);
  }
  if (values.words.empty()) values.words = known_names(name, text.meaning);
  const std::string type = option.get_type_name();
  for (const std::string_view part : parts_of(type, "|")) {
    // The type "off|estimate|X,Y,Z" names words. Other parts describe a value.
    if (is_word(part)) values.words.emplace_back(part);
    constexpr std::array<std::string_view, 9> all_paths{"FILE", "PATH", "SCAN",  "SOURCE", "IN",
                                                        "OUT",  "RUN",  "POSES", "COMMAND"};
    if (std::ranges::find(all_paths, part) != all_paths.end()) {
      values.paths = OptionValues::Paths::all;
    } else if (part == "DIR" || part == "DATASET") {
      values.paths = OptionValues::Paths::directories;
    }
  }
  values.separated_by_commas = option.get_delimiter() == ',';
  return values;
}

}  // namespace flagstone::cli

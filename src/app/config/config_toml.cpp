// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/config_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>
#include <vector>

#include "files/io/message.hpp"
#include "lab/baselines/settings.hpp"
#include "library/mount/mount_settings.hpp"

namespace flagstone::config {
namespace {

/// The shortest text that reads back to the same float, and to a float in TOML.
std::string toml_text(float value) {
  std::string text = fmt::format("{}", value);
  if (std::isfinite(value) && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}
std::string toml_text(int value) { return fmt::format("{}", value); }
std::string toml_text(bool value) { return value ? "true" : "false"; }
std::string toml_text(const std::vector<float>& values) {
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const float value : values) texts.push_back(toml_text(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string toml_text(const std::array<float, 3>& v) {
  return toml_text(std::vector<float>(v.begin(), v.end()));
}

std::string value_text(const Setting& setting) {
  if (const auto* choice = std::get_if<Choice>(&setting.value)) {
    return fmt::format("\"{}\"", choice->names()[choice->index()]);
  }
  return std::visit(
      [](const auto& value) {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(value)>>) {
          return toml_text(*value);
        }
        return std::string();
      },
      setting.value);
}

std::string names_of(const Choice& choice) {
  return fmt::format("\"{}\"", fmt::join(choice.names(), "\", \""));
}

std::string comment_of(const Setting& setting) {
  if (const auto* choice = std::get_if<Choice>(&setting.value)) {
    return fmt::format("{}; {}", setting.meaning, names_of(*choice));
  }
  const bool is_flag = std::holds_alternative<bool*>(setting.value);
  return is_flag ? std::string(setting.meaning)
                 : fmt::format("{}; {}", setting.meaning, to_string(setting.allowed));
}

/// One line for each setting, in tables.
std::string settings_text(const std::vector<Setting>& settings) {
  std::string text;
  std::string_view section;
  for (const Setting& setting : settings) {
    const std::size_t dot = setting.key.find('.');
    const std::string_view own_section =
        dot == std::string_view::npos ? std::string_view() : setting.key.substr(0, dot);
    if (own_section != section) text += fmt::format("\n[{}]\n", own_section);
    section = own_section;
    const std::string_view name =
        dot == std::string_view::npos ? setting.key : setting.key.substr(dot + 1);
    text += fmt::format("{} = {}  # {}\n", name, value_text(setting), comment_of(setting));
  }
  return text;
}

std::string zones_text(const std::vector<Zone>& zones) {
  std::string text =
      "\n# Zones Z_1, Z_2, ... from the sensor outward, 1 to 16; each begins where the one before "
      "ends.\n"
      "# ring_radii: outer radius of each ring, metres, ascending, up to 1000; the last ends the "
      "zone\n"
      "# sectors: N_theta, 1 to 3600\n"
      "# height_margin: M_h; seeds are not chosen below M_h * h_s; below -1, -inf for no margin\n";
  for (const Zone& zone : zones) {
    text += fmt::format("\n[[zones]]\nring_radii = {}\nsectors = {}\nheight_margin = {}\n",
                        toml_text(zone.ring_radii), zone.sectors, toml_text(zone.height_margin));
  }
  return text;
}

/// Says where in the source a node stands.
class Place {
 public:
  Place(std::string_view source, const toml::source_region& region) {
    if (source.empty()) return;
    text_ = fmt::format("{}: line {}, column {}: ", source, region.begin.line, region.begin.column);
  }
  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::invalid_argument(io::printable(text_ + reason));  // keys may hold anything
  }

 private:
  std::string text_;
};

std::string type_name(const toml::node& node) {
  std::ostringstream name;
  name << node.type();
  return name.str();
}

void assign(const toml::node& node, const std::string& key, const Place& place, float& value) {
  if (!node.is_number()) place.refuse(key + " is a number, not a " + type_name(node));
  const double number = node.value_or(0.0);
  constexpr double most = std::numeric_limits<float>::max();
  // Only what is written as inf is infinite.
  value = static_cast<float>(std::isinf(number) ? number : std::clamp(number, -most, most));
}

void assign(const toml::node& node, const std::string& key, const Place& place, int& value) {
  const auto number = node.value_exact<std::int64_t>();
  if (!number) place.refuse(key + " is a whole number, not a " + type_name(node));
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  value = static_cast<int>(std::clamp(*number, -most, most));
}

void assign(const toml::node& node, const std::string& key, const Place& place, bool& value) {
  const auto flag = node.value_exact<bool>();
  if (!flag) place.refuse(key + " is true or false, not a " + type_name(node));
  value = *flag;
}

void assign(const toml::node& node, const std::string& key, const Place& place,
            std::vector<float>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr) place.refuse(key + " is an array of numbers, not a " + type_name(node));
  values.clear();
  for (const toml::node& element : *array) assign(element, key, place, values.emplace_back());
}

void assign(const toml::node& node, const std::string& key, const Place& place,
            std::array<float, 3>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != values.size()) {
    place.refuse(key + " is an array of three numbers");
  }
  for (std::size_t i = 0; i < values.size(); ++i) assign((*array)[i], key, place, values[i]);
}

void assign(const toml::node& node, const std::string& key, const Place& place,
            const Choice& choice) {
  const auto name = node.value_exact<std::string>();
  const auto found = name ? std::ranges::find(choice.names(), *name) : choice.names().end();
  if (found == choice.names().end()) {
    place.refuse(fmt::format("{} is one of {}", key, names_of(choice)));
  }
  choice.choose(static_cast<std::size_t>(found - choice.names().begin()));
}

void assign(const toml::node& node, const Place& place, const Setting& setting) {
  const std::string key(setting.key);
  std::visit(
      [&](const auto& value) {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(value)>>) {
          assign(node, key, place, *value);
        } else {
          assign(node, key, place, value);
        }
      },
      setting.value);
}

Zone zone_of(const toml::node& node, const std::string& name, std::string_view source) {
  const Place place(source, node.source());
  const toml::table* table = node.as_table();
  if (table == nullptr) place.refuse(name + " is a table with ring_radii, sectors, height_margin");
  Zone zone;
  for (const auto& [key, value] : *table) {
    const Place here(source, value.source());
    const std::string full = name + "." + std::string(key.str());
    if (key == "ring_radii") {
      assign(value, full, here, zone.ring_radii);
    } else if (key == "sectors") {
      assign(value, full, here, zone.sectors);
    } else if (key == "height_margin") {
      assign(value, full, here, zone.height_margin);
    } else {
      here.refuse(full + " is no setting; a zone has ring_radii, sectors and height_margin");
    }
  }
  return zone;
}

void assign_zones(const toml::node& node, std::string_view source, std::vector<Zone>& zones) {
  const toml::array* array = node.as_array();
  if (array == nullptr) {
    Place(source, node.source()).refuse("zones is an array of tables, not a " + type_name(node));
  }
  zones.clear();
  for (const toml::node& element : *array) {
    zones.push_back(zone_of(element, fmt::format("zones[{}]", zones.size()), source));
  }
}

std::string sensor_of(const toml::node& node, std::string_view source) {
  const auto name = node.value_exact<std::string>();
  if (!name) {
    Place(source, node.source())
        .refuse("sensor is a text, the name of a sensor or of its file, not a " + type_name(node));
  }
  return *name;
}

/// Is there a setting of this name, or a section?
bool is_known(std::string_view key, const std::vector<Setting>& settings) {
  return std::ranges::any_of(settings, [&](const Setting& setting) {
    return setting.key == key || setting.key.starts_with(std::string(key) + ".");
  });
}

/// What to say of a setting that is not among `settings`, those of the method at hand.
std::string no_setting(const std::string& key, const std::vector<Setting>& settings) {
  const bool is_section_here = is_known(key, settings);
  for (const std::string_view method : {"surface", "patchwork"}) {
    if (is_section_here) break;
    MethodConfig config = default_config(method);
    const bool are_zones = key == "zones" && std::holds_alternative<PatchworkConfig>(config);
    if (!are_zones && !is_known(key, settings_of(config))) continue;
    return fmt::format("{} is no setting of this method, but of --method {}", key, method);
  }
  return key + " is no setting; 'flagstone config --method NAME' prints all there are";
}

void apply_table(const toml::table& table, const std::string& prefix, std::string_view source,
                 const std::vector<Setting>& settings, std::vector<Zone>* zones) {
  for (const auto& [key, node] : table) {
    const std::string full = prefix + std::string(key.str());
    const Place place(source, node.source());
    const auto setting = std::ranges::find(settings, full, &Setting::key);
    if (full == "sensor") {
      sensor_of(node, source);
    } else if (full == "zones" && zones != nullptr) {
      assign_zones(node, source, *zones);
    } else if (setting != settings.end()) {
      assign(node, place, *setting);
    } else if (is_known(full, settings) && node.is_table()) {
      apply_table(*node.as_table(), full + ".", source, settings, zones);
    } else if (is_known(full, settings)) {
      place.refuse(full + " is a table of settings, not a " + type_name(node));
    } else {
      place.refuse(no_setting(full, settings));
    }
  }
}

toml::table parsed(std::string_view text, std::string_view source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    Place(source, error.source()).refuse(std::string(error.description()));
  }
}

/// `zones` is null for methods that have none.
void apply_text(std::string_view text, std::string_view source,
                const std::vector<Setting>& settings, std::vector<Zone>* zones) {
  apply_table(parsed(text, source), "", source, settings, zones);
}

}  // namespace

std::string to_toml(MethodConfig config) {
  const std::string text = settings_text(settings_of(config));
  const auto* patchwork = std::get_if<PatchworkConfig>(&config);
  return patchwork == nullptr ? text : text + zones_text(patchwork->zones);
}

std::string to_toml(MountSettings mount) { return settings_text(settings_of(mount)); }

void apply_toml(std::string_view text, std::string_view source, MethodConfig& config,
                MountSettings& mount) {
  auto* patchwork = std::get_if<PatchworkConfig>(&config);
  std::vector<Setting> settings = settings_of(config);
  std::ranges::move(settings_of(mount), std::back_inserter(settings));
  apply_text(text, source, settings, patchwork == nullptr ? nullptr : &patchwork->zones);
}

void apply_toml(std::string_view text, std::string_view source, MethodConfig& config) {
  auto* patchwork = std::get_if<PatchworkConfig>(&config);
  apply_text(text, source, settings_of(config), patchwork == nullptr ? nullptr : &patchwork->zones);
}

void apply_toml(std::string_view text, std::string_view source, PatchworkConfig& config) {
  apply_text(text, source, settings_of(config), &config.zones);
}

std::optional<std::string> sensor_named_in(std::string_view text, std::string_view source) {
  const toml::table table = parsed(text, source);
  const toml::node* node = table.get("sensor");
  if (node == nullptr) return std::nullopt;
  return sensor_of(*node, source);
}

void set_sensor_height(float height, MethodConfig& config) {
  for (const Setting& setting : settings_of(config)) {
    if (setting.key == "sensor_height") *std::get<float*>(setting.value) = height;
  }
}

}  // namespace flagstone::config

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/config_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>
#include <vector>

#include "files/io/load_bytes.hpp"
#include "files/io/message.hpp"
#include "library/methods/method.hpp"
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

/// One line per setting, in TOML tables.
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
      "\n# 1 to 16 zones Z_1, Z_2, ... from the sensor outward. Each starts where the previous one "
      "ends.\n"
      "# ring_radii: outer radius of each ring in metres, ascending, up to 1000; the last one is "
      "the "
      "end of the zone\n"
      "# sectors: number of sectors N_theta, 1 to 3600\n"
      "# height_margin: M_h; points below M_h * h_s are not seeds; below -1, or -inf for no "
      "limit\n";
  for (const Zone& zone : zones) {
    text += fmt::format("\n[[zones]]\nring_radii = {}\nsectors = {}\nheight_margin = {}\n",
                        toml_text(zone.ring_radii), zone.sectors, toml_text(zone.height_margin));
  }
  return text;
}

std::string location_of(const toml::source_region& region, std::string_view source) {
  if (source.empty()) return {};
  return fmt::format("{}: line {}, column {}: ", source, region.begin.line, region.begin.column);
}

Value value_of(const toml::node& node, std::string_view source) {
  Value value{.held = {}, .place = location_of(node.source(), source)};
  node.visit([&](const auto& held) {
    if constexpr (toml::is_table<decltype(held)>) {
      Value::Table& table = value.held.emplace<Value::Table>();
      for (const auto& [key, element] : held) {
        table.push_back({std::string(key.str()), value_of(element, source)});
      }
    } else if constexpr (toml::is_array<decltype(held)>) {
      Value::List& list = value.held.emplace<Value::List>();
      for (const toml::node& element : held) list.push_back(value_of(element, source));
    } else if constexpr (toml::is_chronological<decltype(held)>) {
      std::ostringstream type;
      type << node.type();
      value.held = Value::Other{type.str()};
    } else {
      value.held = held.get();
    }
  });
  return value;
}

std::string text_of(const std::string& file) {
  std::vector<std::byte> bytes;
  const Status status = io::load_bytes(file, bytes);
  if (!status.ok()) throw std::invalid_argument(status.message());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string to_toml(MethodConfig config) {
  const std::string text = settings_text(config.settings());
  const auto* patchwork = config.get_if<PatchworkConfig>();
  return patchwork == nullptr ? text : text + zones_text(patchwork->zones);
}

std::string to_toml(MountSettings mount) { return settings_text(settings_of(mount)); }

Value parse_toml(std::string_view text, std::string_view source) {
  try {
    return value_of(toml::parse(text, source), source);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(
        io::printable(location_of(error.source(), source) + std::string(error.description())));
  }
}

Value parse_toml_file(const std::string& file) { return parse_toml(text_of(file), file); }

void apply_toml(std::string_view text, std::string_view source, MethodConfig& config,
                MountSettings& mount) {
  apply(parse_toml(text, source), config, mount);
}

std::optional<std::string> sensor_named_in(const Value& table) {
  const Value* sensor = table.find("sensor");
  if (sensor == nullptr) return std::nullopt;
  const auto* name = std::get_if<std::string>(&sensor->held);
  if (name == nullptr) {
    throw std::invalid_argument(io::printable(
        sensor->place + "sensor must be a string, the name of a sensor or of its file"));
  }
  return *name;
}

}  // namespace flagstone::config

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/setting_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "files/io/message.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/methods/method.hpp"
#include "library/mount/mount_settings.hpp"

namespace flagstone::config {
namespace {

[[noreturn]] void refuse(const Value& value, const std::string& reason) {
  throw std::invalid_argument(
      io::printable(value.place + reason));  // keys may contain any character
}

std::string type_of(const Value& value) {
  if (const auto* other = std::get_if<Value::Other>(&value.held)) return "a " + other->type;
  constexpr std::array<const char*, 7> types = {
      "", "a boolean", "an integer", "a floating-point number", "a string", "an array", "a table"};
  return types.at(value.held.index());
}

std::vector<std::string_view> keys_of(const std::vector<Setting>& settings) {
  std::vector<std::string_view> keys;
  keys.reserve(settings.size());
  for (const Setting& setting : settings) keys.push_back(setting.key);
  return keys;
}

void assign(const Value& from, const std::string& key, float& value) {
  double number = 0;
  if (const auto* real = std::get_if<double>(&from.held)) {
    number = *real;
  } else if (const auto* whole = std::get_if<std::int64_t>(&from.held)) {
    number = static_cast<double>(*whole);
  } else {
    refuse(from, key + " must be a number, got " + type_of(from));
  }
  value = to_float(number);
}

void assign(const Value& from, const std::string& key, int& value) {
  const auto* whole = std::get_if<std::int64_t>(&from.held);
  if (whole == nullptr) refuse(from, key + " must be an integer, got " + type_of(from));
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  value = static_cast<int>(std::clamp(*whole, -most, most));
}

void assign(const Value& from, const std::string& key, bool& value) {
  const auto* flag = std::get_if<bool>(&from.held);
  if (flag == nullptr) refuse(from, key + " must be true or false, got " + type_of(from));
  value = *flag;
}

void assign(const Value& from, const std::string& key, std::vector<float>& values) {
  const auto* list = std::get_if<Value::List>(&from.held);
  if (list == nullptr) refuse(from, key + " must be an array of numbers, got " + type_of(from));
  values.clear();
  for (const Value& element : *list) assign(element, key, values.emplace_back());
}

void assign(const Value& from, const std::string& key, std::array<float, 3>& values) {
  const auto* list = std::get_if<Value::List>(&from.held);
  if (list == nullptr || list->size() != values.size()) {
    refuse(from, key + " must be an array of three numbers");
  }
  for (std::size_t i = 0; i < values.size(); ++i) assign((*list)[i], key, values[i]);
}

void assign(const Value& from, const std::string& key, const Choice& choice) {
  const auto* name = std::get_if<std::string>(&from.held);
  const auto names = choice.names();
  const auto found = name != nullptr ? std::ranges::find(names, *name) : names.end();
  if (found == names.end()) {
    refuse(from, fmt::format("{} must be one of \"{}\"{}", key, fmt::join(names, "\", \""),
                             name == nullptr ? "" : did_you_mean(*name, names)));
  }
  choice.choose(static_cast<std::size_t>(found - names.begin()));
}

void assign(const Value& from, const Setting& setting) {
  const std::string key(setting.key);
  std::visit(
      [&](const auto& to) {
        if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(to)>>) {
          assign(from, key, *to);
        } else {
          assign(from, key, to);
        }
      },
      setting.value);
}

Zone zone_of(const Value& from, const std::string& name) {
  const auto* table = std::get_if<Value::Table>(&from.held);
  if (table == nullptr) {
    refuse(from, name + " must be a table with ring_radii, sectors and height_margin");
  }
  Zone zone;
  for (const auto& [key, value] : *table) {
    std::string full = name;
    full.append(".").append(key);
    if (key == "ring_radii") {
      assign(value, full, zone.ring_radii);
    } else if (key == "sectors") {
      assign(value, full, zone.sectors);
    } else if (key == "height_margin") {
      assign(value, full, zone.height_margin);
    } else {
      refuse(value,
             fmt::format("no setting '{}' (expected ring_radii, sectors, height_margin)", full));
    }
  }
  return zone;
}

void assign(const Value& from, std::vector<Zone>& zones) {
  const auto* list = std::get_if<Value::List>(&from.held);
  if (list == nullptr) refuse(from, "zones must be an array of tables, got " + type_of(from));
  zones.clear();
  for (const Value& element : *list) {
    zones.push_back(zone_of(element, fmt::format("zones[{}]", zones.size())));
  }
}

/// The settings of a method and of the mounting pose, by key.
class Settings {
 public:
  Settings(MethodConfig& config, MountSettings& mount) : settings_(config.settings()) {
    std::ranges::move(settings_of(mount), std::back_inserter(settings_));
    if (auto* patchwork = config.get_if<PatchworkConfig>()) zones_ = &patchwork->zones;
  }

  void apply(const Value& table, const std::string& prefix = "") const {
    for (const auto& [key, value] : table.table()) {
      const std::string full = prefix + key;
      const auto setting = std::ranges::find(settings_, full, &Setting::key);
      if (full == "sensor") continue;
      if (full == "zones" && zones_ != nullptr) {
        assign(value, *zones_);
      } else if (setting != settings_.end()) {
        assign(value, *setting);
      } else if (!has_section(full)) {
        refuse(value, no_setting(full));
      } else if (!std::holds_alternative<Value::Table>(value.held)) {
        refuse(value, full + " must be a table of settings, got " + type_of(value));
      } else {
        apply(value, full + ".");
      }
    }
  }

  /// True if every key of the table is a setting.
  [[nodiscard]] bool have(const Value& table, const std::string& prefix = "") const {
    return std::ranges::all_of(table.table(), [&](const Entry& entry) {
      const std::string full = prefix + entry.key;
      if (!has_section(full)) return full == "sensor" || has(full);
      return !std::holds_alternative<Value::Table>(entry.value.held) ||
             have(entry.value, full + ".");
    });
  }

 private:
  [[nodiscard]] bool has(std::string_view key) const {
    return (key == "zones" && zones_ != nullptr) ||
           std::ranges::find(settings_, key, &Setting::key) != settings_.end();
  }
  [[nodiscard]] bool has_section(const std::string& key) const {
    return std::ranges::any_of(
        settings_, [&](const Setting& setting) { return setting.key.starts_with(key + "."); });
  }

  /// The problem with an unknown key, and a hint.
  [[nodiscard]] std::string no_setting(const std::string& key) const {
    for (const std::string_view method : {"surface", "patchwork"}) {
      MethodConfig config = default_config(method);
      MountSettings mount;
      const Settings others(config, mount);
      if (!others.has(key) && !others.has_section(key)) continue;
      return fmt::format("this method has no setting '{}' (method {} has it)", key, method);
    }
    std::vector<std::string_view> known = keys_of(settings_);
    if (zones_ != nullptr) known.emplace_back("zones");
    std::string meant = did_you_mean(key, known);
    const auto inside = std::ranges::find_if(
        known, [&](std::string_view other) { return other.ends_with("." + key); });
    if (meant.empty() && inside != known.end()) {
      meant = fmt::format(" (did you mean '{}'?)", *inside);
    }
    return fmt::format("no setting '{}'{}", key,
                       meant.empty() ? " (docs/reference/settings.md lists them)" : meant);
  }

  std::vector<Setting> settings_;
  std::vector<Zone>* zones_ = nullptr;
};

}  // namespace

const Value* Value::find(std::string_view key) const {
  const auto found = std::ranges::find(table(), key, &Entry::key);
  return found == table().end() ? nullptr : &found->value;
}

void apply(const Value& table, MethodConfig& config, MountSettings& mount) {
  Settings(config, mount).apply(table);
}

bool has_settings_of(const Value& table, MethodConfig config) {
  MountSettings mount;
  return Settings(config, mount).have(table);
}

}  // namespace flagstone::config

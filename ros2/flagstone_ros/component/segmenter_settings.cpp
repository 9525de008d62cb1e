// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "segmenter_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "declaration.hpp"
#include "library/core/setting.hpp"
#include "library/methods/method.hpp"
#include "library/mount/mount_settings.hpp"

namespace flagstone_ros {
namespace {

namespace config = flagstone::config;

/// Settings that the parameters sensor_height and tilt set.
constexpr std::array<std::string_view, 4> separate = {"sensor_height", "mount.height", "mount.tilt",
                                                      "mount.up"};
/// Parameters of the node that choose the segmenter.
constexpr std::array<std::string_view, 7> of_segmenter = {
    "method", "sensor", "preset", "config", "sensor_height", "tilt", "threads"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

[[noreturn]] void reject(std::string_view name, std::string_view expected) {
  throw std::invalid_argument(fmt::format("{}: has the wrong type (expected {})", name, expected));
}

const std::string* text_of(const ParameterValues& given, std::string_view name) {
  const auto found = given.find(name);
  if (found == given.end()) return nullptr;
  const auto* text = std::get_if<std::string>(&found->second);
  if (text == nullptr) reject(name, "a string");
  return text;
}

std::string text_of(const ParameterValues& given, std::string_view name,
                    std::string_view otherwise) {
  const std::string* text = text_of(given, name);
  return text == nullptr ? std::string(otherwise) : *text;
}

/// The words of an error, after the name of the parameter.
template <class Set>
void set_named(std::string_view name, const Set& set) {
  try {
    set();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", name, error.what()));
  }
}

void set_height(const ParameterValues& given, config::MountChoice& mount) {
  const auto found = given.find("sensor_height");
  if (found == given.end()) return;
  if (const auto* metres = std::get_if<double>(&found->second)) {
    mount.set_height(static_cast<float>(*metres));
  } else if (const auto* whole = std::get_if<std::int64_t>(&found->second)) {
    mount.set_height(static_cast<float>(*whole));
  } else if (const auto* word = std::get_if<std::string>(&found->second)) {
    set_named("sensor_height", [&] { mount.set_height(std::string_view(*word)); });
  } else {
    reject("sensor_height", "a number, estimate or track");
  }
}

/// Returns whether the up direction comes from an IMU.
bool set_tilt(const ParameterValues& given, config::MountChoice& mount) {
  const auto found = given.find("tilt");
  if (found == given.end()) return false;
  if (const auto* up = std::get_if<std::vector<double>>(&found->second); up && up->size() == 3) {
    mount.set_tilt(std::array{static_cast<float>((*up)[0]), static_cast<float>((*up)[1]),
                              static_cast<float>((*up)[2])});
    return false;
  }
  const auto* word = std::get_if<std::string>(&found->second);
  if (word == nullptr) reject("tilt", "off, estimate, imu or three numbers [x, y, z]");
  if (*word == "imu") {
    mount.tilt = flagstone::TiltSource::off;  // clouds are levelled before they are segmented
    return true;
  }
  if (*word != "off" && *word != "estimate") {
    throw std::invalid_argument(fmt::format(
        "tilt: '{}' is not a tilt (expected off, estimate, imu or three numbers [x, y, z])",
        *word));
  }
  mount.set_tilt(std::string_view(*word));
  return false;
}

unsigned threads_of(const ParameterValues& given) {
  const auto found = given.find("threads");
  if (found == given.end()) return 1;
  const auto* threads = std::get_if<std::int64_t>(&found->second);
  if (threads == nullptr) reject("threads", "an integer");
  constexpr std::int64_t most = 1024;
  if (*threads < 1 || *threads > most) {
    throw std::invalid_argument(
        fmt::format("threads: {} is out of range (expected 1 to {})", *threads, most));
  }
  return static_cast<unsigned>(*threads);
}

config::Value value_of(const ParameterValue& value) {
  config::Value converted;
  std::visit(
      [&](const auto& held) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, std::vector<double>>) {
          config::Value::List list;
          list.reserve(held.size());
          for (const double number : held) list.push_back({.held = number});
          converted.held = std::move(list);
        } else {
          converted.held = held;
        }
      },
      value);
  return converted;
}

/// The shortest decimal number that rounds to a float: 1.73 instead of 1.7300000190734863.
double decimal(float number) { return std::strtod(fmt::format("{}", number).c_str(), nullptr); }

template <class Numbers>
std::vector<double> decimals(const Numbers& numbers) {
  std::vector<double> list;
  list.reserve(numbers.size());
  for (const float number : numbers) list.push_back(decimal(number));
  return list;
}

ParameterValue value_of(const flagstone::Setting& setting) {
  return std::visit(
      [](const auto& held) -> ParameterValue {
        using Held = std::remove_cvref_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, flagstone::Choice>) {
          return std::string(held.names()[held.index()]);
        } else if constexpr (std::is_same_v<Held, float*>) {
          return decimal(*held);
        } else if constexpr (std::is_same_v<Held, int*>) {
          return std::int64_t{*held};
        } else if constexpr (std::is_same_v<Held, bool*>) {
          return *held;
        } else {
          return decimals(*held);
        }
      },
      setting.value);
}

std::string constraints_of(const flagstone::Setting& setting) {
  if (std::holds_alternative<bool*>(setting.value)) return {};
  const auto* choice = std::get_if<flagstone::Choice>(&setting.value);
  if (choice == nullptr) return to_string(setting.allowed);
  std::string text;
  const auto names = choice->names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

/// All settings of a method and of its mounting pose; they point into the arguments.
std::vector<flagstone::Setting> all_settings(flagstone::MethodConfig& config,
                                             flagstone::MountSettings& mount) {
  std::vector<flagstone::Setting> all = config.settings();
  std::ranges::copy(settings_of(mount), std::back_inserter(all));
  std::erase_if(all, [](const flagstone::Setting& s) { return contains(separate, s.key); });
  return all;
}

}  // namespace

bool is_segmenter_parameter(std::string_view name) { return contains(of_segmenter, name); }

SegmenterSettings::SegmenterSettings(const ParameterValues& given)
    : method_([&] {
        config::MethodChoice choice;
        const std::string method = text_of(given, "method", methods.front());
        if (!contains(methods, method)) {
          throw std::invalid_argument(fmt::format("method: '{}' is not a method (expected {})",
                                                  method, fmt::join(methods, " or ")));
        }
        choice.methods = {method};
        choice.preset = text_of(given, "preset", "default");
        choice.sensor = text_of(given, "sensor", "");
        choice.config_file = text_of(given, "config", "");
        choice.option_prefix = "";
        set_height(given, choice.mount);
        uses_imu_ = set_tilt(given, choice.mount);

        // The names of the settings do not depend on their values.
        flagstone::MethodConfig defaults = flagstone::default_config(method);
        flagstone::MountSettings mount;
        config::Value::Table table;
        for (const flagstone::Setting& setting : all_settings(defaults, mount)) {
          const auto found = given.find(setting.key);
          if (found != given.end()) {
            table.push_back({std::string(setting.key), value_of(found->second)});
          }
        }
        choice.settings = {{.method = {}, .table = {.held = std::move(table)}, .source = {}}};
        return config::resolve_one(choice);
      }()),
      threads_(threads_of(given)) {}

std::vector<SettingParameter> SegmenterSettings::settings() const {
  flagstone::MethodConfig config = method_.config;
  flagstone::MountSettings mount = method_.mount;
  std::vector<SettingParameter> parameters;
  for (const flagstone::Setting& setting : all_settings(config, mount)) {
    SettingParameter& parameter = parameters.emplace_back();
    parameter.name = setting.key;
    parameter.value = value_of(setting);
    parameter.description = setting.meaning;
    parameter.constraints = constraints_of(setting);
    parameter.is_number = std::holds_alternative<float*>(setting.value) ||
                          std::holds_alternative<int*>(setting.value);
    parameter.low = setting.allowed.low;
    parameter.high = setting.allowed.allow_infinity ? std::numeric_limits<double>::infinity()
                                                    : setting.allowed.high;
  }
  return parameters;
}

ParameterValues SegmenterSettings::values() const {
  ParameterValues values;
  for (SettingParameter& parameter : settings()) {
    values.insert_or_assign(std::move(parameter.name), std::move(parameter.value));
  }
  const flagstone::MountSettings& mount = method_.mount;
  if (mount.height == flagstone::HeightSource::fixed) {
    values["sensor_height"] = decimal(mount.mount.sensor_height);
  } else {
    values["sensor_height"] = std::string(to_string(mount.height));
  }
  if (uses_imu_) {
    values["tilt"] = std::string("imu");
  } else if (mount.tilt == flagstone::TiltSource::fixed) {
    values["tilt"] = decimals(mount.mount.up);
  } else {
    values["tilt"] = std::string(to_string(mount.tilt));
  }
  return values;
}

std::unique_ptr<flagstone::GravityAlignedSegmenter> SegmenterSettings::make() const {
  const auto& [name, config, mount] = method_;
  return std::make_unique<flagstone::GravityAlignedSegmenter>(
      config.make(threads_), sensor_height_of(config, mount.mount.sensor_height), mount);
}

}  // namespace flagstone_ros

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "flagstone/sensor.hpp"
#include "library/c_api/errors.hpp"
#include "library/c_api/handles.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/methods/method.hpp"

namespace flagstone::c_api {
namespace {

// Names, meanings and units of settings are literals, so a null character follows them.
const char* text_of(std::string_view literal) { return literal.empty() ? "" : literal.data(); }

[[noreturn]] void throw_wrong_type(std::string_view key, std::string_view expected) {
  throw std::invalid_argument(
      std::string(key).append(": has another type (expected ").append(expected) + ')');
}

/// What a setting expects, for messages.
std::string_view expected_by(const Setting& setting) {
  struct Expected {
    std::string_view operator()(const float*) const { return "a number"; }
    std::string_view operator()(const int*) const { return "an integer"; }
    std::string_view operator()(const bool*) const { return "0 or 1"; }
    std::string_view operator()(const std::vector<float>*) const { return "an array of numbers"; }
    std::string_view operator()(const std::array<float, 3>*) const {
      return "an array of three numbers";
    }
    std::string_view operator()(const Choice&) const { return "the name of a choice"; }
  };
  return std::visit(Expected{}, setting.value);
}

const Setting& find(const flagstone_settings* settings, const char* name) {
  require(settings, "settings", "a handle");
  require(name, "name", "the name of a setting");
  const auto found = std::ranges::find(settings->list, std::string_view(name), &Setting::key);
  if (found != settings->list.end()) return *found;
  std::vector<std::string_view> known;
  known.reserve(settings->list.size());
  for (const Setting& setting : settings->list) known.push_back(setting.key);
  std::string hint = did_you_mean(name, known);
  if (hint.empty()) hint = " (flagstone_settings_at() lists them)";
  throw std::invalid_argument(std::string("settings: no setting '") + name + '\'' + hint);
}

/// Writes the value of a setting into its description.
struct Describe {
  flagstone_setting& setting;

  void operator()(const float* value) const {
    setting.type = FLAGSTONE_NUMBER;
    setting.number = *value;
  }
  void operator()(const int* value) const {
    setting.type = FLAGSTONE_INTEGER;
    setting.number = *value;
  }
  void operator()(const bool* value) const {
    setting.type = FLAGSTONE_BOOLEAN;
    setting.number = *value ? 1 : 0;
    setting.maximum = 1;
  }
  void operator()(const std::vector<float>* values) const { describe(*values); }
  void operator()(const std::array<float, 3>* values) const { describe(*values); }
  void operator()(const Choice& choice) const {
    setting.type = FLAGSTONE_CHOICE;
    setting.choice = text_of(choice.names()[choice.index()]);
  }

  void describe(std::span<const float> values) const {
    setting.type = FLAGSTONE_NUMBERS;
    setting.numbers = values.data();
    setting.number_count = values.size();
  }
};

flagstone_setting description_of(const Setting& setting) {
  flagstone_setting description{};
  description.name = text_of(setting.key);
  description.meaning = text_of(setting.meaning);
  description.unit = text_of(setting.allowed.unit);
  description.excludes_minimum = setting.allowed.exclusive_min;
  description.allows_infinity = setting.allowed.allow_infinity;
  description.minimum = setting.allowed.low;
  description.maximum = setting.allowed.high;
  std::visit(Describe{description}, setting.value);
  return description;
}

/// Sets a number, an integer or a boolean.
struct SetNumber {
  const Setting& setting;
  double number;

  void operator()(float* value) const { *value = to_float(number); }
  void operator()(int* value) const {
    if (number != std::trunc(number)) throw_wrong_type(setting.key, "an integer");  // also NaN
    *value = static_cast<int>(std::clamp<double>(number, std::numeric_limits<int>::min(),
                                                 std::numeric_limits<int>::max()));
  }
  void operator()(bool* value) const {
    if (number != 0 && number != 1) throw_wrong_type(setting.key, "0 or 1");
    *value = number == 1;
  }
  void operator()(const auto& /*other*/) const {
    throw_wrong_type(setting.key, expected_by(setting));
  }
};

/// Sets an array of numbers.
struct SetNumbers {
  const Setting& setting;
  std::span<const float> numbers;

  void operator()(std::vector<float>* values) const {
    values->assign(numbers.begin(), numbers.end());
  }
  void operator()(std::array<float, 3>* values) const {
    if (numbers.size() != values->size()) throw_wrong_type(setting.key, expected_by(setting));
    std::ranges::copy(numbers, values->begin());
  }
  void operator()(const auto& /*other*/) const {
    throw_wrong_type(setting.key, expected_by(setting));
  }
};

std::unique_ptr<flagstone_settings> settings_of_preset(const char* method, const char* preset) {
  require(method, "method", "the name of a method");
  require(preset, "preset", "the name of a preset");
  const Method& chosen = find_method(method);
  const bool has_presets = chosen.preset != nullptr || !chosen.starts_from.empty();
  if (!has_presets && std::string_view(preset) != "default") {
    throw std::invalid_argument(std::string("method ") + method + ": has no preset '" + preset +
                                "' (expected default)");
  }
  MethodConfig config = preset_config(method, preset);
  if (chosen.derive) config = chosen.derive(config);
  return std::make_unique<flagstone_settings>(std::move(config));
}

std::unique_ptr<flagstone_settings> settings_for_sensor(const char* method, const char* name,
                                                        float sensor_height) {
  require(method, "method", "the name of a method");
  require(name, "sensor", "the name of a sensor");
  Sensor sensor = Sensor::named(name);
  if (!std::isnan(sensor_height)) sensor.height = sensor_height;
  return std::make_unique<flagstone_settings>(default_config(method, sensor));
}

}  // namespace
}  // namespace flagstone::c_api

using namespace flagstone;
using c_api::create;
using c_api::guarded;
using c_api::require;

size_t flagstone_method_count(void) { return method_names().size(); }

const char* flagstone_method_name(size_t index) {
  const auto names = method_names();
  return index < names.size() ? c_api::text_of(names[index]) : nullptr;
}

flagstone_status flagstone_settings_create(const char* method, flagstone_settings** settings,
                                           flagstone_error* error) {
  return create(settings, error, [&] {
    require(method, "method", "the name of a method");
    return std::make_unique<flagstone_settings>(default_config(method));
  });
}

flagstone_status flagstone_settings_create_for_preset(const char* method, const char* preset,
                                                      flagstone_settings** settings,
                                                      flagstone_error* error) {
  return create(settings, error, [&] { return c_api::settings_of_preset(method, preset); });
}

flagstone_status flagstone_settings_create_for_sensor(const char* method, const char* sensor,
                                                      float sensor_height,
                                                      flagstone_settings** settings,
                                                      flagstone_error* error) {
  return create(settings, error,
                [&] { return c_api::settings_for_sensor(method, sensor, sensor_height); });
}

void flagstone_settings_destroy(flagstone_settings* settings) { delete settings; }

size_t flagstone_settings_count(const flagstone_settings* settings) {
  return settings == nullptr ? 0 : settings->list.size();
}

flagstone_status flagstone_settings_at(const flagstone_settings* settings, size_t index,
                                       flagstone_setting* setting, flagstone_error* error) {
  return guarded(error, [&] {
    require(settings, "settings", "a handle");
    require(setting, "setting", "the address of a struct");
    c_api::require_index(index, settings->list.size());
    *setting = c_api::description_of(settings->list[index]);
  });
}

flagstone_status flagstone_settings_find(const flagstone_settings* settings, const char* name,
                                         flagstone_setting* setting, flagstone_error* error) {
  return guarded(error, [&] {
    const Setting& found = c_api::find(settings, name);
    require(setting, "setting", "the address of a struct");
    *setting = c_api::description_of(found);
  });
}

const char* flagstone_settings_choice(const flagstone_settings* settings, const char* name,
                                      size_t index) {
  if (settings == nullptr || name == nullptr) return nullptr;
  const auto found = std::ranges::find(settings->list, std::string_view(name), &Setting::key);
  if (found == settings->list.end()) return nullptr;
  const auto* choice = std::get_if<Choice>(&found->value);
  if (choice == nullptr || index >= choice->names().size()) return nullptr;
  return c_api::text_of(choice->names()[index]);
}

flagstone_status flagstone_settings_set_number(flagstone_settings* settings, const char* name,
                                               double value, flagstone_error* error) {
  return guarded(error, [&] {
    const Setting& setting = c_api::find(settings, name);
    std::visit(c_api::SetNumber{setting, value}, setting.value);
  });
}

flagstone_status flagstone_settings_set_numbers(flagstone_settings* settings, const char* name,
                                                const float* values, size_t count,
                                                flagstone_error* error) {
  return guarded(error, [&] {
    const Setting& setting = c_api::find(settings, name);
    if (count > 0) require(values, "values", "the address of the numbers");
    std::visit(c_api::SetNumbers{setting, {values, count}}, setting.value);
  });
}

flagstone_status flagstone_settings_set_choice(flagstone_settings* settings, const char* name,
                                               const char* value, flagstone_error* error) {
  return guarded(error, [&] {
    const Setting& setting = c_api::find(settings, name);
    require(value, "value", "the name of a choice");
    const auto* choice = std::get_if<Choice>(&setting.value);
    if (choice == nullptr) c_api::throw_wrong_type(setting.key, c_api::expected_by(setting));
    const auto names = choice->names();
    const auto found = std::ranges::find(names, std::string_view(value));
    if (found == names.end()) throw std::invalid_argument(no_such(setting.key, value, names));
    choice->choose(static_cast<std::size_t>(found - names.begin()));
  });
}

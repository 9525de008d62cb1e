// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/config/method_choice.hpp"
#include "bindings.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patch.hpp"
#include "flagstone/sensor.hpp"
#include "library/core/setting.hpp"
#include "library/mount/mount_settings.hpp"

namespace nb = nanobind;

namespace flagstone::python {
namespace {

nb::str str_of(std::string_view text) { return nb::str(text.data(), text.size()); }

nb::tuple tuple_of(const std::vector<double>& numbers) {
  nb::list list;
  for (const double number : numbers) list.append(number);
  return nb::tuple(list);
}

nb::list names_of_methods() {
  nb::list names;
  for (const std::string_view name : config::method_names()) names.append(str_of(name));
  return names;
}

nb::list names_of_labels() {
  nb::list names;
  for (std::size_t code = 0; code < label_count; ++code) {
    names.append(to_string(static_cast<Label>(code)));
  }
  return names;
}

nb::list names_of_verdicts() {
  nb::list names;
  for (auto code = static_cast<unsigned>(Verdict::ground);
       code <= static_cast<unsigned>(Verdict::off_surface); ++code) {
    names.append(to_string(static_cast<Verdict>(code)));
  }
  return names;
}

nb::list sensors() {
  nb::list list;
  for (const Sensor& sensor : Sensor::known()) {
    nb::dict entry;
    entry["name"] = sensor.name;
    entry["title"] = sensor.title;
    entry["elevations"] = tuple_of(sensor.elevations);
    entry["firings"] = sensor.firings;
    entry["azimuth_begin"] = sensor.azimuth_begin;
    entry["azimuth_end"] = sensor.azimuth_end;
    entry["rosette"] = tuple_of(sensor.rosette);
    entry["min_range"] = sensor.min_range;
    entry["max_range"] = sensor.max_range;
    entry["range_sigma"] = sensor.range_sigma;
    entry["height"] = sensor.height;
    list.append(entry);
  }
  return list;
}

const char* type_of(const Setting& setting) {
  constexpr std::array<const char*, 6> names = {"float",           "int", "bool", "Sequence[float]",
                                                "Sequence[float]", "str"};
  return names.at(setting.value.index());
}

/// "fixed, estimate or track"
std::string names_of(const Choice& choice) {
  std::string text;
  for (std::size_t i = 0; i < choice.names().size(); ++i) {
    const bool is_last = i + 1 == choice.names().size();
    text += i == 0 ? "" : is_last ? " or " : ", ";
    text += choice.names()[i];
  }
  return text;
}

/// Key, Python type, meaning, allowed values in words, and minimum and maximum of a number.
nb::list list_of(const std::vector<Setting>& settings) {
  nb::list list;
  for (const Setting& setting : settings) {
    const auto* choice = std::get_if<Choice>(&setting.value);
    const bool is_flag = std::holds_alternative<bool*>(setting.value);
    const bool is_number = std::holds_alternative<float*>(setting.value) ||
                           std::holds_alternative<int*>(setting.value);
    const ValidRange& allowed = setting.allowed;
    nb::object low = nb::none();
    nb::object high = nb::none();
    if (is_number) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      low = nb::float_(allowed.low);
      high = nb::float_(allowed.allow_infinity ? infinity : allowed.high);
    }
    std::string words;
    if (choice != nullptr) words = names_of(*choice);
    if (choice == nullptr && !is_flag) words = to_string(allowed);
    list.append(nb::make_tuple(str_of(setting.key), type_of(setting), str_of(setting.meaning),
                               words, low, high));
  }
  return list;
}

/// The settings of a method, without the mounting pose.
nb::list settings(const std::string& method) {
  MethodConfig config = config::resolve_one({.methods = {method}}).config;
  return list_of(config.settings());
}

nb::list mount_settings() {
  MountSettings mount;
  return list_of(settings_of(mount));
}

}  // namespace

void bind_known(nb::module_& module) {
  module.def("method_names", &names_of_methods, nb::sig("def method_names() -> list[str]"));
  module.def("label_names", &names_of_labels, nb::sig("def label_names() -> list[str]"));
  module.def("verdict_names", &names_of_verdicts, nb::sig("def verdict_names() -> list[str]"));
  module.def("sensors", &sensors, nb::sig("def sensors() -> list[dict[str, typing.Any]]"));
  module.def("settings", &settings, nb::arg("method"),
             nb::sig("def settings(method: str) -> list[tuple[str, str, str, str, float | None, "
                     "float | None]]"));
  module.def("mount_settings", &mount_settings,
             nb::sig("def mount_settings() -> list[tuple[str, str, str, str, float | None, "
                     "float | None]]"));
}

}  // namespace flagstone::python

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>

#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/methods/method.hpp"
#include "library/patchwork/patchwork_settings.hpp"
#include "library/surface/surface_settings.hpp"

namespace flagstone {
namespace {

Method patchwork_method() {
  return {.name = "patchwork",
          .title = "Patchwork",
          .type = &config_type<PatchworkConfig, Patchwork>("patchwork"),
          .defaults = [] { return PatchworkConfig{}; },
          .for_sensor = [](const Sensor& s) { return PatchworkConfig::for_sensor(s); },
          .presets = PatchworkConfig::preset_names(),
          .preset = [](std::string_view name) { return PatchworkConfig::preset(name); }};
}

Method surface_method() {
  return {.name = "surface",
          .title = "Surface",
          .type = &config_type<SurfaceConfig, Surface>("surface"),
          .defaults = [] { return SurfaceConfig{}; },
          .for_sensor = [](const Sensor& s) { return SurfaceConfig::for_sensor(s); }};
}

struct Registry {
  std::vector<Method> methods;
  std::vector<std::string_view> names;  // of `methods`, in the same order

  void add(std::vector<Method> added) {
    std::ranges::move(methods, std::back_inserter(added));
    methods = std::move(added);
    names.clear();
    for (const Method& method : methods) names.push_back(method.name);
  }
};

Registry& registry() {
  static Registry known = [] {
    Registry first;
    first.add({patchwork_method(), surface_method()});
    return first;
  }();
  return known;
}

const ConfigType& type_of(const std::any& config) {
  for (const Method& method : registry().methods) {
    if (*method.type->id == config.type()) return *method.type;
  }
  throw std::invalid_argument(
      "no registered method has a configuration of this type (for a baseline, call "
      "register_baselines() first)");
}

}  // namespace

MethodConfig::MethodConfig(std::any value) : value_(std::move(value)), type_(&type_of(value_)) {}

std::vector<Setting> MethodConfig::settings() { return type_->settings(value_); }
void MethodConfig::check() const { type_->check(value_); }
std::unique_ptr<Segmenter> MethodConfig::make(unsigned threads) const {
  return type_->make(value_, threads);
}

void register_methods(std::vector<Method> methods) { registry().add(std::move(methods)); }

std::span<const std::string_view> method_names() noexcept { return registry().names; }

const Method& find_method(std::string_view name) {
  const std::vector<Method>& methods = registry().methods;
  const auto found = std::ranges::find(methods, name, &Method::name);
  if (found != methods.end()) return *found;
  throw std::invalid_argument(no_such("method", name, method_names()));
}

std::string_view method_title(std::string_view name) { return find_method(name).title; }

MethodConfig default_config(std::string_view name) {
  const Method& method = find_method(name);
  return method.derive ? method.derive(default_config(method.starts_from)) : method.defaults();
}

MethodConfig default_config(std::string_view name, const Sensor& sensor) {
  const Method& method = find_method(name);
  return method.derive ? method.derive(default_config(method.starts_from, sensor))
                       : method.for_sensor(sensor);
}

MethodConfig preset_config(std::string_view name, std::string_view preset) {
  const Method& method = find_method(name);
  if (!method.starts_from.empty()) return preset_config(method.starts_from, preset);
  return method.preset ? method.preset(preset) : method.defaults();
}

std::unique_ptr<Segmenter> make_segmenter(std::string_view name) {
  return default_config(name).make();
}

std::unique_ptr<Segmenter> make_segmenter(std::string_view name, const MethodConfig& config) {
  if (find_method(name).type != &config.type()) {
    throw std::invalid_argument("method " + std::string(name) +
                                ": the configuration belongs to another method");
  }
  return config.make();
}

float sensor_height_of(MethodConfig config, float otherwise) {
  for (const Setting& setting : config.settings()) {
    if (setting.key == "sensor_height") return *std::get<float*>(setting.value);
  }
  return otherwise;
}

void set_sensor_height(float height, MethodConfig& config) {
  for (const Setting& setting : config.settings()) {
    if (setting.key == "sensor_height") *std::get<float*>(setting.value) = height;
  }
}

}  // namespace flagstone

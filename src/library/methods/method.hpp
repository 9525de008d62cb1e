// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/make_segmenter.hpp"
#include "library/core/setting.hpp"

namespace flagstone {

/// Functions for one type of configuration.
struct ConfigType {
  std::string_view name;  ///< the main method with this type of configuration
  const std::type_info* id;
  std::vector<Setting> (*settings)(std::any& config);
  void (*check)(const std::any& config);
  std::unique_ptr<Segmenter> (*make)(const std::any& config, unsigned threads);
};

/// The functions for `Config`, which `Segmenter` is constructed from. `settings_of(Config&)` must
/// list its settings.
template <class Config, class Segmenter>
const ConfigType& config_type(std::string_view name) {
  static const ConfigType type = {
      .name = name,
      .id = &typeid(Config),
      .settings = [](std::any& config) { return settings_of(*std::any_cast<Config>(&config)); },
      .check = [](const std::any& config) { std::any_cast<Config>(&config)->check(); },
      .make = [](const std::any& config,
                 unsigned threads) -> std::unique_ptr<flagstone::Segmenter> {
        const Config& own = *std::any_cast<Config>(&config);
        if constexpr (std::is_constructible_v<Segmenter, Config, unsigned>) {
          return std::make_unique<Segmenter>(own, threads);
        } else {
          if (threads == 1) return std::make_unique<Segmenter>(own);
          throw std::invalid_argument(
              "threads = " + std::to_string(threads) + ": method " + std::string(type.name) +
              " supports only 1 thread (surface and patchwork support more)");
        }
      }};
  return type;
}

/// A method that can be selected by name.
struct Method {
  std::string_view name;
  std::string_view title;  ///< name in tables
  const ConfigType* type;
  std::function<MethodConfig()> defaults;
  std::function<MethodConfig(const Sensor&)> for_sensor;

  // If empty, "default" is the only preset.
  std::span<const std::string_view> presets{};
  std::function<MethodConfig(std::string_view)> preset{};

  /// The method that this method is derived from: "patchwork" for "czm+u". Its presets and the
  /// user's settings for it also apply to this method, unless `derive` overrides them.
  std::string_view starts_from{};
  std::function<MethodConfig(const MethodConfig&)> derive{};
};

/// Registers methods, in front of those already registered.
void register_methods(std::vector<Method> methods);

/// Throws std::invalid_argument listing the methods if `name` is unknown.
const Method& find_method(std::string_view name);

/// The settings of a preset of a method, before `derive` is applied. Throws std::invalid_argument
/// if the method or the preset is unknown.
MethodConfig preset_config(std::string_view name, std::string_view preset);

/// The sensor height in the settings of a method, metres; `otherwise` if it has none.
float sensor_height_of(MethodConfig config, float otherwise);

/// Sets the sensor height, metres, if the method has one.
void set_sensor_height(float height, MethodConfig& config);

/// Interface of methods that can use one more field of the points, if a scan has it.
class UsesField {
 public:
  virtual ~UsesField() = default;
  /// The name of the field in files.
  [[nodiscard]] virtual std::string_view field() const noexcept = 0;
  /// Sets the values of that field for the next cloud, one per point. They are empty if the cloud
  /// does not have the field. May throw std::bad_alloc.
  virtual void set_field(CloudView cloud, std::span<const double> values) = 0;
};

}  // namespace flagstone

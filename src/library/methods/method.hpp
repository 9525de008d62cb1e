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

/// How configurations of one type are handled.
struct ConfigType {
  std::string_view name;  ///< the method they belong to first of all
  const std::type_info* id;
  std::vector<Setting> (*settings)(std::any& config);
  void (*check)(const std::any& config);
  std::unique_ptr<Segmenter> (*make)(const std::any& config, unsigned threads);
};

/// That of `Config`, whose settings `settings_of(Config&)` lists and whose method is `Segmenter`.
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
          throw std::invalid_argument("threads = " + std::to_string(threads) + ": method " +
                                      std::string(type.name) +
                                      " has 1 thread (surface and patchwork can have more)");
        }
      }};
  return type;
}

/// A method by name.
struct Method {
  std::string_view name;
  std::string_view title;  ///< in tables
  const ConfigType* type;
  std::function<MethodConfig()> defaults;
  std::function<MethodConfig(const Sensor&)> for_sensor;

  // Where there are none, "default" is the only preset.
  std::span<const std::string_view> presets{};
  std::function<MethodConfig(std::string_view)> preset{};

  /// The method whose settings this one starts from: "patchwork" for "czm+u". Its presets, and
  /// what the user sets for it, hold for this one too, as far as `derive` leaves them.
  std::string_view starts_from{};
  std::function<MethodConfig(const MethodConfig&)> derive{};
};

/// Makes methods known, before those that are known already.
void register_methods(std::vector<Method> methods);

/// Throws std::invalid_argument listing the methods for an unknown name.
const Method& find_method(std::string_view name);

/// The settings of a method before the user's; those of the method that it starts from are not yet
/// put through `derive`. Throws std::invalid_argument for an unknown preset.
MethodConfig preset_config(std::string_view name, std::string_view preset);

/// The sensor's height in the settings of a method, metres; `otherwise` if it has none.
float sensor_height_of(MethodConfig config, float otherwise);

/// Sets that height if the method has one.
void set_sensor_height(float height, MethodConfig& config);

/// A method that can use one more field of the points, where a scan has it.
class UsesField {
 public:
  virtual ~UsesField() = default;
  /// The name of the field in files.
  [[nodiscard]] virtual std::string_view field() const noexcept = 0;
  /// The values of that field in the cloud that is segmented next, one for each point; empty if it
  /// has no such field. May throw std::bad_alloc.
  virtual void set_field(CloudView cloud, std::span<const double> values) = 0;
};

}  // namespace flagstone

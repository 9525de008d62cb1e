// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <any>
#include <concepts>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/sensor.hpp"
#include "flagstone/surface_config.hpp"

/// Methods by name. The library provides `patchwork` and `surface`; `register_baselines()` in
/// `flagstone/baselines.hpp` adds the methods that Patchwork is compared with. All functions
/// are thread-safe once the methods are registered.
namespace flagstone {

struct ConfigType;
struct Setting;

/// The configuration of any method: a `SurfaceConfig`, a `PatchworkConfig` or the configuration of
/// a baseline. Not thread-safe: use one instance per thread.
class MethodConfig {
 public:
  /// Stores a copy of `config`. Throws std::invalid_argument if no registered method has a
  /// configuration of this type.
  template <class Config>
    requires(!std::same_as<Config, MethodConfig> && std::copyable<Config> &&
             requires(const Config& c) { c.check(); })
  MethodConfig(Config config) : MethodConfig(std::any(std::move(config))) {}  // NOLINT: converts

  /// The stored configuration; null if it has another type. Valid as long as this object.
  template <class Config>
  [[nodiscard]] Config* get_if() noexcept {
    return std::any_cast<Config>(&value_);
  }
  /// The stored configuration; null if it has another type. Valid as long as this object.
  template <class Config>
  [[nodiscard]] const Config* get_if() const noexcept {
    return std::any_cast<Config>(&value_);
  }

  /// All settings except Patchwork's zones, in the order in which they are printed. They point into
  /// this object.
  [[nodiscard]] std::vector<Setting> settings();

  /// Checks all settings. Throws std::invalid_argument naming the setting, its value and the
  /// allowed range, for the first value out of range.
  void check() const;

  /// Creates a segmenter with this configuration. `threads` is the number of threads that process
  /// one scan together, 1 to 1,024; baselines support only 1. Throws std::invalid_argument if a
  /// setting or the number of threads is out of range.
  [[nodiscard]] std::unique_ptr<Segmenter> make(unsigned threads = 1) const;

  /// Functions for this type of configuration. For internal use.
  [[nodiscard]] const ConfigType& type() const noexcept { return *type_; }

 private:
  explicit MethodConfig(std::any value);

  std::any value_;
  const ConfigType* type_;
};

/// Names of the registered methods. The span is valid until more methods are registered. With the
/// baselines, the methods are, in the order of the paper's Table I:
/// - `ransac`, `gpf`, `line_fit`, `cascaded`, `r_gpf`: the methods that Patchwork is compared with;
/// - `r_gpf+u`: R-GPF with uprightness as the only test;
/// - `czm+u`, `czm+u+e`, `czm+u+e+f`: Patchwork's zones and fit with one, two or all three terms of
///   the ground likelihood;
/// - `patchwork`;
/// - `surface`, which is not in that table.
std::span<const std::string_view> method_names() noexcept;

/// Name of a method for tables, such as "CZM + U". Throws std::invalid_argument listing the methods
/// if `name` is unknown.
std::string_view method_title(std::string_view name);

/// The default settings of a method. Throws std::invalid_argument listing the methods if `name` is
/// unknown.
MethodConfig default_config(std::string_view name);

/// The settings of a method for a sensor. For `patchwork` and `surface` they are derived from the
/// sensor (see PatchworkConfig::for_sensor and SurfaceConfig::for_sensor); other methods get their
/// default settings with the sensor's height. Throws std::invalid_argument if `name` is unknown or
/// the method cannot derive settings from the sensor.
MethodConfig default_config(std::string_view name, const Sensor& sensor);

/// Creates a segmenter with its default configuration. Throws std::invalid_argument if `name` is
/// unknown.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name);

/// Creates a segmenter with the given configuration. Throws std::invalid_argument if `name` is
/// unknown, `config` belongs to another method or a setting is out of range.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name, const MethodConfig& config);

}  // namespace flagstone

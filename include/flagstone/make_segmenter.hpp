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

/// Methods by name. The library has `patchwork` and `surface`; `register_baselines()` of
/// `flagstone/baselines.hpp` adds those that Patchwork is compared with.
namespace flagstone {

struct ConfigType;
struct Setting;

/// The configuration of any method: a `SurfaceConfig`, a `PatchworkConfig`, or that of a baseline.
class MethodConfig {
 public:
  /// Holds a copy of `config`. Throws std::invalid_argument if no registered method has a
  /// configuration of this type.
  template <class Config>
    requires(!std::same_as<Config, MethodConfig> && std::copyable<Config> &&
             requires(const Config& c) { c.check(); })
  MethodConfig(Config config) : MethodConfig(std::any(std::move(config))) {}  // NOLINT: converts

  /// What it holds; null if that is of another type.
  template <class Config>
  [[nodiscard]] Config* get_if() noexcept {
    return std::any_cast<Config>(&value_);
  }
  /// What it holds; null if that is of another type.
  template <class Config>
  [[nodiscard]] const Config* get_if() const noexcept {
    return std::any_cast<Config>(&value_);
  }

  /// All settings in the order they are printed; they point into this object. Patchwork's zones are
  /// not among them.
  [[nodiscard]] std::vector<Setting> settings();

  /// Throws std::invalid_argument naming the setting, its value and the range allowed.
  void check() const;

  /// A segmenter with this configuration; `threads` work on one scan together. Throws
  /// std::invalid_argument if a value or the number of threads is not allowed.
  [[nodiscard]] std::unique_ptr<Segmenter> make(unsigned threads = 1) const;

  /// How its type is handled.
  [[nodiscard]] const ConfigType& type() const noexcept { return *type_; }

 private:
  explicit MethodConfig(std::any value);

  std::any value_;
  const ConfigType* type_;
};

/// The methods that are registered. With the baselines, in the order of the paper's Table I:
/// - `ransac`, `gpf`, `line_fit`, `cascaded`, `r_gpf`: what Patchwork is compared with;
/// - `r_gpf+u`: R-GPF judged by uprightness alone;
/// - `czm+u`, `czm+u+e`, `czm+u+e+f`: Patchwork's zones and fit with one, two and all three terms
///   of the ground likelihood;
/// - `patchwork`;
/// - `surface`, which is not in that table.
std::span<const std::string_view> method_names() noexcept;

/// The name of a method in tables: "CZM + U". Throws as default_config().
std::string_view method_title(std::string_view name);

/// The default settings of a method. Throws std::invalid_argument listing the methods for an
/// unknown name.
MethodConfig default_config(std::string_view name);

/// The settings of a method for a sensor: derived from it where the method has a rule (`for_sensor`
/// of Patchwork and Surface), else the default ones with the sensor's height. Throws
/// std::invalid_argument likewise.
MethodConfig default_config(std::string_view name, const Sensor& sensor);

/// A segmenter of that name with its default configuration.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name);

/// A segmenter of that name with this configuration. Throws std::invalid_argument for an unknown
/// name, a configuration of another method and a value out of range.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name, const MethodConfig& config);

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/make_segmenter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone {
namespace {

constexpr std::array<std::string_view, 11> names = {
    "ransac", "gpf",     "line_fit",  "cascaded",  "r_gpf",  "r_gpf+u",
    "czm+u",  "czm+u+e", "czm+u+e+f", "patchwork", "surface"};

/// A configuration with the terms of the ground likelihood that come after the first plus sign of
/// `name`, "czm+u+e", and no others.
PatchworkConfig with_terms_of(std::string_view name, PatchworkConfig config) {
  const std::string_view terms = name.substr(std::min(name.find('+'), name.size()));
  config.uprightness.enabled = terms.find("+u") != std::string_view::npos;
  config.elevation.enabled = terms.find("+e") != std::string_view::npos;
  config.flatness.enabled = terms.find("+f") != std::string_view::npos;
  return config;
}

/// Rings of the sensor's own; a rosette has none.
void use_beams_of(const Sensor& sensor, CascadedConfig& config) {
  if (sensor.draws_rosette()) return;
  config.beam_elevations.assign(sensor.elevations.rbegin(), sensor.elevations.rend());
  config.max_range = static_cast<float>(sensor.max_range);
  const double firings_a_turn = sensor.firings * 360 / (sensor.azimuth_end - sensor.azimuth_begin);
  config.columns = static_cast<int>(std::clamp(firings_a_turn, 1.0, 3600.0));
}

std::unique_ptr<Segmenter> make(const PatchworkConfig& config) {
  return std::make_unique<Patchwork>(config);
}
std::unique_ptr<Segmenter> make(const SurfaceConfig& config) {
  return std::make_unique<Surface>(config);
}
std::unique_ptr<Segmenter> make(const RansacConfig& config) {
  return std::make_unique<Ransac>(config);
}
std::unique_ptr<Segmenter> make(const GpfConfig& config) { return std::make_unique<Gpf>(config); }
std::unique_ptr<Segmenter> make(const LineFitConfig& config) {
  return std::make_unique<LineFit>(config);
}
std::unique_ptr<Segmenter> make(const CascadedConfig& config) {
  return std::make_unique<Cascaded>(config);
}

}  // namespace

std::span<const std::string_view> method_names() noexcept { return names; }

MethodConfig default_config(std::string_view name) {
  return default_config(name, PatchworkConfig());
}

MethodConfig default_config(std::string_view name, const PatchworkConfig& patchwork) {
  if (name == "ransac") return RansacConfig{};
  if (name == "gpf") return GpfConfig{};
  if (name == "line_fit") return LineFitConfig{};
  if (name == "cascaded") return CascadedConfig{};
  if (name == "patchwork") return patchwork;
  if (name == "surface") return SurfaceConfig{};
  if (std::ranges::find(names, name) == names.end()) {
    std::ostringstream message;
    message << "no method is named \"" << name << "\"; there are";
    for (const std::string_view known : names) message << ' ' << known;
    throw std::invalid_argument(message.str());
  }
  return with_terms_of(name, name.starts_with("czm") ? patchwork : r_gpf_config());
}

MethodConfig default_config(std::string_view name, const Sensor& sensor) {
  if (name == "surface") return SurfaceConfig::for_sensor(sensor);
  if (name == "patchwork" || name.starts_with("czm")) {
    return default_config(name, PatchworkConfig::for_sensor(sensor));
  }
  sensor.check();
  MethodConfig config = default_config(name);
  for (const Setting& setting : settings_of(config)) {
    if (setting.key == "sensor_height") {
      *std::get<float*>(setting.value) = static_cast<float>(sensor.height);
    }
  }
  if (auto* cascaded = std::get_if<CascadedConfig>(&config)) use_beams_of(sensor, *cascaded);
  return config;
}

void check(const MethodConfig& config) {
  std::visit([](const auto& settings) { settings.check(); }, config);
}

std::unique_ptr<Segmenter> make_segmenter(std::string_view name) {
  return make_segmenter(name, default_config(name));
}

std::unique_ptr<Segmenter> make_segmenter(std::string_view name, const MethodConfig& config) {
  if (config.index() != default_config(name).index()) {
    throw std::invalid_argument("the configuration given to method " + std::string(name) +
                                " is another method's");
  }
  return std::visit([](const auto& settings) { return make(settings); }, config);
}

}  // namespace flagstone

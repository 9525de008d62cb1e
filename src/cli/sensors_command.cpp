// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sensors_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/terminal.hpp"
#include "files/io/sensor_file.hpp"

namespace flagstone::cli {
namespace {

struct SensorsOptions {
  std::vector<std::string> sensors;
};

struct Layout {
  std::size_t rings = 0;
  std::size_t bins = 0;
  float reach = 0;  ///< L_max, metres
};

Layout layout_of(const PatchworkConfig& config) {
  Layout layout{.reach = config.zones.back().ring_radii.back()};
  for (const Zone& zone : config.zones) {
    layout.rings += zone.ring_radii.size();
    layout.bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  return layout;
}

std::string beams_text(const Sensor& sensor) {
  return sensor.draws_rosette() ? "rosette" : fmt::format("{}", sensor.elevations.size());
}

std::string row_of(const Sensor& sensor) {
  const PatchworkConfig config = PatchworkConfig::for_sensor(sensor);
  const Layout layout = layout_of(config);
  return fmt::format(
      "{:<12} {:<24} {:>7} {:>7.1f} {:>6.1f} {:>6} {:>8.2f} {:>5} {:>5} {:>5} {:>11}\n",
      sensor.name, sensor.title, beams_text(sensor), sensor.elevations.front(),
      sensor.elevations.back(), sensor.azimuth_end - sensor.azimuth_begin, sensor.height,
      layout.rings, config.zones.size(), layout.bins,
      fmt::format("{:.1f} to {:.1f}", config.min_range, layout.reach));
}

int list_sensors(const SensorsOptions& options) {
  std::vector<Sensor> sensors(Sensor::known().begin(), Sensor::known().end());
  bool all_read = true;
  if (!options.sensors.empty()) sensors.clear();
  for (const std::string& name : options.sensors) {
    Sensor sensor;
    const Status status = io::find_sensor(name, sensor);
    if (!status.ok()) {
      print_error(status.message());
      all_read = false;
    } else {
      sensors.push_back(std::move(sensor));
    }
  }
  constexpr int usage_error = 2;  // as with --sensor
  if (sensors.empty()) return usage_error;
  fmt::print("{:<12} {:<24} {:>7} {:>7} {:>6} {:>6} {:>8} {:>5} {:>5} {:>5} {:>11}\n", "name",
             "title", "beams", "from °", "to °", "view °", "height m", "rings", "zones", "bins",
             "range m");
  for (const Sensor& sensor : sensors) {
    try {
      fmt::print("{}", row_of(sensor));
    } catch (const std::invalid_argument& error) {  // it sees no ground
      print_error(error.what());
      all_read = false;
    }
  }
  return all_read ? 0 : usage_error;
}

}  // namespace

std::string derivation_text(const Sensor& sensor, const PatchworkConfig& config) {
  const Layout layout = layout_of(config);
  return fmt::format(
      "# Rings lie where the beams of sensor {} ({}) meet flat ground,\n"
      "# h / tan(-elevation) away: edges halfway between beams, two beams or 1.8 m in each, no "
      "ring\n"
      "# shorter than 15 % of its distance. Bins are about as wide as long and have 20 points or "
      "more.\n"
      "# {} rings, {} zones, {} bins. See docs/reference/sensors.md.\n",
      sensor.name, sensor.title, layout.rings, config.zones.size(), layout.bins);
}

void add_sensors_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SensorsOptions>();
  CLI::App* command = app.add_subcommand(
      "sensors",
      "List the sensors that settings are derived from, and the zones they give.\n\n"
      "Example:  flagstone sensors mine.toml\n\n"
      "rings, zones, bins, range: those of --method patchwork with this --sensor.\n");
  command
      ->add_option("sensors", options->sensors,
                   "Names, or .toml files of sensors of your own. Default: all that are known")
      ->type_name("NAME|FILE");
  command->callback([options, &exit_code] { exit_code = list_sensors(*options); });
}

}  // namespace flagstone::cli

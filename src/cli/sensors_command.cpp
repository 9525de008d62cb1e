// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/commands.hpp"
#include "cli/derivation_text.hpp"
#include "cli/help.hpp"
#include "cli/terminal.hpp"
#include "files/io/sensor_file.hpp"

namespace flagstone::cli {
namespace {

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

class SensorsCommand final : public Command {
 public:
  using Command::Command;
  std::vector<std::string> names;

  int run() override {
    std::vector<Sensor> sensors(Sensor::known().begin(), Sensor::known().end());
    bool all_read = true;
    if (!names.empty()) sensors.clear();
    for (const std::string& name : names) {
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
      } catch (const std::invalid_argument& error) {  // the sensor sees no ground
        print_error(error.what());
        all_read = false;
      }
    }
    return all_read ? 0 : usage_error;
  }
};

}  // namespace

std::string derivation_text(const Sensor& sensor, const PatchworkConfig& config) {
  const Layout layout = layout_of(config);
  return fmt::format(
      "# Zones derived from the sensor {} ({}): its beams meet flat ground at\n"
      "# h / tan(-elevation). Ring edges are halfway between beams. A ring has two beams, or one "
      "if "
      "it\n"
      "# is at least 1.8 m long, and is never shorter than 15 % of its distance. Bins are about as "
      "wide\n"
      "# as long and have at least 20 points. {} rings, {} zones, {} bins.\n"
      "# See docs/explanation/settings-from-a-sensor.md.\n",
      sensor.name, sensor.title, layout.rings, config.zones.size(), layout.bins);
}

std::unique_ptr<Command> add_sensors_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "sensors", "List the known sensors and the Patchwork zones derived from each.");
  set_help(*command,
           {.examples = {{"flagstone sensors", "all known sensors"},
                         {"flagstone sensors mine.toml", "your own sensor, from a TOML file"}},
            .notes = "The columns rings, zones, bins and range describe --method patchwork with "
                     "--sensor set to this sensor.",
            .exit_codes = "0, success; 2, usage error or unknown sensor."});
  auto made = std::make_unique<SensorsCommand>(*command);
  command->add_option("sensors", made->names, "Sensor names, or TOML files that describe a sensor")
      ->default_str("all known sensors")
      ->type_name("NAME|FILE");
  return made;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/simulate_command.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <string>

#include "app/simulate.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::cli {
namespace {

int simulate(const app::SimulateOptions& options) {
  catch_interrupts();
  ProgressBar bar;
  Stopwatch watch;
  const app::Simulation simulation = app::simulate(options, bar.callbacks());
  const double seconds = watch.lap() / 1000;
  bar.clear();
  if (simulation.interrupted) return 1;
  fmt::print("{}, {}, seed {}: {} frames in {} drive{}, {} simulated, {} kept as they were\n",
             options.scene, simulation.sensor, options.seed, options.frames, simulation.drives,
             simulation.drives == 1 ? "" : "s", simulation.simulated, simulation.kept);
  if (simulation.simulated > 0) {
    fmt::print("{:.1f} s, {:.1f} scans per second\n", seconds,
               static_cast<double>(simulation.simulated) / seconds);
  }
  fmt::print("{}\n", io::printable(simulation.folder));
  return 0;
}

std::string description() {
  std::string text =
      "Simulate a sequence of scans with exact truth.\n\n"
      "Example:  flagstone simulate --scene steep_street --frames 200 --output simulated\n\n"
      "Written as SemanticKITTI lays out a sequence. Run again, it keeps the frames that are "
      "there.\n\nScenes:\n";
  for (const sim::SceneKind& scene : sim::scene_kinds()) {
    text += fmt::format("  {:<17} {}\n", scene.name, scene.summary);
  }
  text += "\nNoise:\n";
  for (const sim::NoiseLevel& level : sim::noise_levels()) {
    text += fmt::format("  {:<16} {}\n", level.name, level.summary);
  }
  text += "\nWeather:\n";
  for (const sim::Weather& weather : sim::weathers()) {
    text += fmt::format("  {:<16} {}\n", weather.name, weather.summary);
  }
  text += "\nSensors:\n";
  for (const Sensor& sensor : Sensor::known()) {
    text += fmt::format("  {:<17} {}\n", sensor.name, sensor.title);
  }
  return text;
}

}  // namespace

void add_simulate_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<app::SimulateOptions>();
  CLI::App* command = app.add_subcommand("simulate", description());
  command->add_option("--scene", options->scene, "What is simulated; the names stand above")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--sensor", options->sensor,
                   "What takes the scans; the names stand above, or a file of your own")
      ->type_name("NAME|FILE.toml")
      ->capture_default_str();
  command
      ->add_option(
          "--sensor-height", options->sensor_height,
          fmt::format("Metres above the ground, 0 to {}. Default: the sensor's usual height",
                      app::max_simulated_height))
      ->type_name("M");
  command
      ->add_option("--tilt", options->tilt,
                   "How the sensor leans on its vehicle, degrees, -90 to 90 each: positive pitch "
                   "looks down ahead, positive roll has the right side lower")
      ->type_name("PITCH,ROLL")
      ->capture_default_str();
  command->add_option("--noise", options->noise, "How the sensor errs; the names stand above")
      ->type_name("NAME")
      ->capture_default_str();
  command
      ->add_option("--weather", options->weather,
                   "What is in the air and on the road; one or more of the names above")
      ->delimiter(',')
      ->type_name("NAME,...")
      ->capture_default_str();
  command->add_flag("--keep-no-returns", options->keep_no_returns,
                    "Write missing returns as points at (0, 0, 0), as many drivers do");
  command
      ->add_option("--frames", options->frames,
                   fmt::format("Scans, 1 to {}; every {} in a new environment", app::max_frames,
                               sim::frames_per_drive))
      ->type_name("N")
      ->capture_default_str();
  add_seed_option(*command, options->seed,
                  "Which environments; the same seed gives the same bytes");
  command
      ->add_option(
          "-o,--output", options->output,
          "Folder for sequences/NN with velodyne, labels, ground, returns (created if missing)")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--sequence", options->sequence,
                   "Two digits, so that one folder can hold several sequences")
      ->type_name("NN")
      ->capture_default_str();
  add_threads_option(*command, options->threads);
  command->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace flagstone::cli

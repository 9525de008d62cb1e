// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <string>
#include <utility>

#include "app/simulate.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "flagstone/sensor.hpp"
#include "lab/sim/alignment.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/extent.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/pose_noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::cli {
namespace {

/// The names and one-line summaries of scenes, noise levels or weathers.
NameList summaries(std::string title, const auto& kinds) {
  NameList list{.title = std::move(title)};
  for (const auto& kind : kinds) {
    list.names.emplace_back(std::string(kind.name), std::string(kind.summary));
  }
  return list;
}

/// The scenes that can be longer than a stretch.
std::string long_scenes() {
  std::string names;
  for (const sim::SceneKind& kind : sim::scene_kinds()) {
    if (kind.make_long == nullptr) continue;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
  }
  return names;
}

Help help_text() {
  NameList sensors{.title = "Sensors"};
  for (const Sensor& sensor : Sensor::known())
    sensors.names.emplace_back(sensor.name, sensor.title);
  return {
      .examples =
          {{"flagstone simulate --scene flat_street --output simulated"},
           {"flagstone simulate --scene steep_street --sensor vlp-16 --weather rain -o out"},
           {"flagstone simulate --scene park --length 1000 --loop --frames 252 -o loop"}},
      .lists = {summaries("Scenes", sim::scene_kinds()), summaries("Noise", sim::noise_levels()),
                summaries("Weather", sim::weathers()), summaries("Pose noise", sim::pose_noises()),
                sensors},
      .notes =
          "The output is a SemanticKITTI sequence with exact ground truth. The output "
          "depends only on the options. Frames that already exist are kept, so the same command "
          "resumes an interrupted run.",
      .exit_codes = "0, success; 1, interrupted, or a file cannot be written; 2, usage error."};
}

class SimulateCommand final : public Command {
 public:
  using Command::Command;
  app::SimulateOptions options;

  int run() override {
    catch_interrupts();
    ProgressBar bar;
    Stopwatch watch;
    const app::Simulation simulation = app::simulate(options, bar.callbacks());
    const double seconds = watch.lap() / 1000;
    bar.clear();
    if (simulation.interrupted) return 1;
    fmt::print("{}, {}, seed {}: {} frames in {} environment{}, {} simulated, {} kept\n",
               options.scene, simulation.sensor, options.seed, options.frames, simulation.drives,
               simulation.drives == 1 ? "" : "s", simulation.simulated, simulation.kept);
    if (simulation.simulated > 0) {
      fmt::print("{:.1f} s, {:.1f} scans per second\n", seconds,
                 static_cast<double>(simulation.simulated) / seconds);
    }
    fmt::print("{}\n", io::printable(simulation.folder));
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_simulate_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("simulate", "Simulate a sequence of scans with exact ground truth.");
  set_help(*command, help_text());
  auto made = std::make_unique<SimulateCommand>(*command);
  app::SimulateOptions* const options = &made->options;
  command->option_defaults()->group("Scene");
  command->add_option("--scene", options->scene, "Kind of environment; see Scenes below")
      ->required()
      ->type_name("NAME");
  command
      ->add_option("--frames", options->frames,
                   fmt::format("Number of scans, 1 to {}; a new environment every --length",
                               app::max_frames))
      ->check(in_range(std::size_t{1}, app::max_frames))
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option(
          "--length", options->length,
          fmt::format("Length of an environment in metres, {:g} to {:g}, rounded up to a "
                      "multiple of {:g}; for {}",
                      sim::stretch_length, app::max_length, sim::stretch_length, long_scenes()))
      ->check(in_range(sim::stretch_length, app::max_length))
      ->type_name("M")
      ->capture_default_str();
  command->add_flag("--loop", options->loop,
                    fmt::format("Environments are circuits of --length, at least {:g} m, which the "
                                "vehicle passes twice",
                                sim::shortest_circuit));
  command
      ->add_option("--rate", options->pace.rate,
                   fmt::format("Scans per second, {} to {}; with 10, a continuous run",
                               app::min_rate, app::max_rate))
      ->check(in_range(app::min_rate, app::max_rate))
      ->type_name("HZ")
      ->capture_default_str();
  command
      ->add_option(
          "--speed", options->pace.speed,
          fmt::format("Speed of the vehicle in m/s, {} to {}; traffic is as fast, compared "
                      "with the vehicle, as at 8 m/s",
                      app::min_speed, app::max_speed))
      ->check(in_range(app::min_speed, app::max_speed))
      ->type_name("M/S")
      ->capture_default_str();
  command->add_flag(
      "--distortion", options->pace.distortion,
      "Motion distortion: the sensor moves while it measures a scan; adds the time of "
      "each point");
  command
      ->add_option("--pose-noise", options->pose_noise,
                   "Errors of the poses in poses_measured.txt; see Pose noise below")
      ->type_name("NAME")
      ->capture_default_str();
  command->add_option("--noise", options->noise, "Measurement errors; see Noise below")
      ->type_name("NAME")
      ->capture_default_str();
  command
      ->add_option("--weather", options->weather,
                   "Rain, dust and wet roads; one or more names from Weather below, separated by "
                   "commas")
      ->delimiter(',')
      ->type_name("LIST")
      ->default_str("clear");
  add_seed_option(*command, options->seed, "Random seed of the environments");

  command->option_defaults()->group("Sensor");
  command
      ->add_option("--sensor", options->sensor,
                   "Sensor to simulate: a name from Sensors below, or a TOML file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command
      ->add_option("--sensor-height", options->sensor_height,
                   fmt::format("Height of the sensor above the ground in metres, 0 to {}",
                               app::max_simulated_height))
      ->check(in_range(0.0, app::max_simulated_height))
      ->default_str("the usual height of the sensor")
      ->type_name("M");
  command
      ->add_option("--tilt", options->tilt,
                   "Tilt of the sensor on its vehicle in degrees, -90 to 90 each; positive pitch "
                   "looks down ahead, positive roll lowers the right side")
      ->type_name("PITCH,ROLL")
      ->capture_default_str();

  command->option_defaults()->group(output_group);
  command
      ->add_option("-o,--output", options->output,
                   "Output directory, created if it does not exist; gets sequences/NN with "
                   "velodyne, labels, ground, returns and motion")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--sequence", options->sequence,
                   "Two digits; use different ones for several sequences in one directory")
      ->type_name("NN")
      ->capture_default_str();
  command->add_flag("--keep-no-returns", options->keep_no_returns,
                    "Write missing returns as points at (0, 0, 0), as drivers often do");
  add_threads_option(*command, options->threads);
  return made;
}

}  // namespace flagstone::cli

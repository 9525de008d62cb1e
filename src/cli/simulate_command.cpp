// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/simulate_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "cli/interrupt.hpp"
#include "cli/print_error.hpp"
#include "cli/progress.hpp"
#include "cli/simulated_sequence.hpp"
#include "files/io/sensor_file.hpp"
#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::cli {
namespace {

constexpr std::size_t drive_length = sim::frames_per_drive;

struct SimulateOptions {
  std::string scene;
  std::string sensor = "hdl-64e";
  double sensor_height = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the sensor's own
  std::string tilt = "0,0";
  std::string noise = "default";
  std::vector<std::string> weather{"clear"};
  bool keep_no_returns = false;
  std::size_t frames = 200;
  std::uint64_t seed = 1;
  std::string output;
  std::string sequence = "00";
  unsigned threads = 0;
};

/// One world and the frames taken of it. Made by who comes first, shared by all who help.
struct DriveInWork {
  std::once_flag planned, built;
  std::unique_ptr<sim::Drive> drive;
  std::unique_ptr<sim::Scene> scene;
  std::atomic<std::size_t> next = 0;     ///< frame of the drive that nobody has taken yet
  std::atomic<std::size_t> working = 0;  ///< threads at it
};

/// Simulates the missing frames of a sequence with several threads. Every frame depends on nothing
/// but scene, seed and its number.
class SequenceRun {
 public:
  SequenceRun(const SimulatedSequence& files, const sim::SceneKind& scene,
              const SequenceOrigin& origin)
      : files_(files),
        scene_(scene),
        origin_(origin),
        drives_((origin.frames + drive_length - 1) / drive_length),
        poses_(origin.frames),
        kept_(origin.frames) {
    for (std::size_t frame = 0; frame < kept_.size(); ++frame) kept_[frame] = files.has(frame);
    progress_ = std::make_unique<Progress>(missing());
  }

  /// Works until all is done or somebody interrupts; throws what went wrong.
  void run(unsigned threads) {
    progress_->show(0);
    {
      const std::size_t crew_size = std::min<std::size_t>(threads, kept_.size());
      std::vector<std::jthread> crew;
      for (std::size_t i = 1; i < crew_size; ++i) crew.emplace_back([this] { work(); });
      work();
    }
    progress_->clear();
    if (failure_) std::rethrow_exception(failure_);
  }

  [[nodiscard]] std::size_t missing() const {
    return static_cast<std::size_t>(std::ranges::count(kept_, false));
  }
  [[nodiscard]] std::size_t kept() const { return kept_.size() - missing(); }
  [[nodiscard]] std::size_t simulated() const noexcept { return simulated_; }
  [[nodiscard]] bool complete() const { return simulated_ == missing(); }
  [[nodiscard]] const std::vector<sim::Frame>& poses() const noexcept { return poses_; }

 private:
  [[nodiscard]] bool stopped() const noexcept { return failed_ || interrupted(); }

  // Takes a drive that nobody is at, so that worlds are made side by side; then helps with those
  // that are not finished.
  void work() {
    try {
      for (std::size_t i = next_drive_++; i < drives_.size() && !stopped(); i = next_drive_++) {
        take_frames(i);
      }
      for (std::size_t i = 0; i < drives_.size() && !stopped(); ++i) take_frames(i);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
  }

  void take_frames(std::size_t index) {
    const std::size_t first = index * drive_length;
    const std::size_t count = std::min(drive_length, kept_.size() - first);
    DriveInWork& at = drives_[index];
    ++at.working;
    while (!stopped()) {
      const std::size_t offset = at.next++;
      if (offset >= count) break;
      std::call_once(at.planned, [&] { plan(at, index); });
      if (kept_[first + offset]) continue;
      std::call_once(at.built, [&] { at.scene = std::make_unique<sim::Scene>(at.drive->scene()); });
      const int frame = static_cast<int>(offset);
      const sim::SimulatedScan scan =
          at.drive->scan(*at.scene, origin_.noise, frame, origin_.keep_no_returns);
      files_.write(first + offset, scan, at.drive->ground_of(scan, frame));
      report();
    }
    // The last one to leave takes the world down: who comes later finds no frame to take.
    if (--at.working == 0 && at.next >= count) release(at);
  }

  void plan(DriveInWork& at, std::size_t index) {
    at.drive = std::make_unique<sim::Drive>(scene_, origin_.sensor, origin_.mounting,
                                            sim::drive_seed(origin_.seed, index));
    const std::size_t first = index * drive_length;
    for (std::size_t i = 0; i < drive_length && first + i < poses_.size(); ++i) {
      poses_[first + i] = at.drive->poses()[i];
    }
  }

  // Two threads may leave one after the other and both see nobody left.
  void release(DriveInWork& at) {
    const std::scoped_lock lock(mutex_);
    at.scene.reset();
    at.drive.reset();
  }

  void report() {
    const std::scoped_lock lock(mutex_);
    progress_->show(++simulated_);
  }

  const SimulatedSequence& files_;
  const sim::SceneKind& scene_;
  const SequenceOrigin& origin_;
  std::vector<DriveInWork> drives_;
  std::vector<sim::Frame> poses_;
  std::vector<bool> kept_;
  std::atomic<std::size_t> next_drive_ = 0;
  std::atomic<bool> failed_ = false;

  std::mutex mutex_;  // of what follows
  std::unique_ptr<Progress> progress_;
  std::size_t simulated_ = 0;
  std::exception_ptr failure_;
};

/// An error that names those there are, each of which has a `name`.
std::invalid_argument no_such(std::string_view option, std::string_view name, const auto& all) {
  std::vector<std::string_view> names;
  for (const auto& each : all) names.push_back(each.name);
  return std::invalid_argument(
      fmt::format("{}: there is no '{}'; choose {}", option, name, fmt::join(names, ", ")));
}

const sim::SceneKind& scene_named(const std::string& name) {
  if (const sim::SceneKind* scene = sim::find_scene_kind(name)) return *scene;
  throw no_such("--scene", name, sim::scene_kinds());
}

// SemanticKITTI's folders have two digits.
void check_sequence(const std::string& name) {
  const bool digits =
      std::ranges::all_of(name, [](char letter) { return letter >= '0' && letter <= '9'; });
  if (name.size() != 2 || !digits) {
    throw std::invalid_argument(
        fmt::format("--sequence: '{}' is no name of a sequence; give two digits, 00 to 99", name));
  }
}

sim::Mounting mounting_of(const SimulateOptions& options, const Sensor& sensor) {
  sim::Mounting mounting{.height = sensor.height};
  if (!std::isnan(options.sensor_height)) mounting.height = options.sensor_height;
  constexpr double most = 90;
  const std::string& text = options.tilt;
  const char* end = text.data() + text.size();
  const auto [comma, bad_pitch] = std::from_chars(text.data(), end, mounting.pitch);
  const bool has_roll = bad_pitch == std::errc() && comma != end && *comma == ',';
  const auto [rest, bad_roll] = std::from_chars(has_roll ? comma + 1 : end, end, mounting.roll);
  if (!has_roll || bad_roll != std::errc() || rest != end || !(std::abs(mounting.pitch) <= most) ||
      !(std::abs(mounting.roll) <= most)) {
    throw std::invalid_argument(fmt::format(
        "--tilt: '{}' is not PITCH,ROLL; give two numbers of degrees, -90 to 90, such as 15,-5",
        text));
  }
  return mounting;
}

Sensor sensor_found(const std::string& name_or_file) {
  Sensor sensor;
  if (const Status status = io::find_sensor(name_or_file, sensor); !status.ok()) {
    throw std::invalid_argument(fmt::format("--sensor: {}", status.message()));
  }
  return sensor;
}

SequenceOrigin origin_of(const SimulateOptions& options) {
  const Sensor sensor = sensor_found(options.sensor);
  const sim::NoiseLevel* level = sim::find_noise_level(options.noise);
  if (level == nullptr) throw no_such("--noise", options.noise, sim::noise_levels());
  sim::Noise noise = level->noise;
  for (const std::string& name : options.weather) {
    const sim::Weather* weather = sim::find_weather(name);
    if (weather == nullptr) throw no_such("--weather", name, sim::weathers());
    weather->add_to(noise);
  }
  return {.scene = options.scene,
          .sensor = sensor,
          .mounting = mounting_of(options, sensor),
          .noise_name = options.noise,
          .weather = options.weather,
          .noise = noise,
          .keep_no_returns = options.keep_no_returns,
          .seed = options.seed,
          .frames = options.frames};
}

int simulate(const SimulateOptions& options) {
  const sim::SceneKind& scene = scene_named(options.scene);
  check_sequence(options.sequence);
  const SimulatedSequence files(std::filesystem::path(options.output) / "sequences" /
                                options.sequence);
  const SequenceOrigin origin = origin_of(options);
  files.begin(origin);
  const unsigned threads =
      options.threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : options.threads;

  catch_interrupts();
  Stopwatch watch;
  SequenceRun sequence(files, scene, origin);
  sequence.run(threads);
  const double seconds = watch.lap() / 1000;

  if (!sequence.complete()) {
    print_error(fmt::format("interrupted, {} of {} frames are done; run it again for the rest",
                            sequence.kept() + sequence.simulated(), options.frames));
    return 1;
  }
  files.write_poses(sequence.poses());
  const std::size_t drives = (options.frames + drive_length - 1) / drive_length;
  fmt::print("{}, {}, seed {}: {} frames in {} drive{}, {} simulated, {} kept as they were\n",
             options.scene, origin.sensor.name, options.seed, options.frames, drives,
             drives == 1 ? "" : "s", sequence.simulated(), sequence.kept());
  if (sequence.simulated() > 0) {
    fmt::print("{:.1f} s, {:.1f} scans a second\n", seconds,
               static_cast<double>(sequence.simulated()) / seconds);
  }
  fmt::print("{}\n", files.folder().string());
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
  auto options = std::make_shared<SimulateOptions>();
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
      ->add_option("--sensor-height", options->sensor_height,
                   "Metres above the ground, 0 to 100. Default: where the sensor usually is")
      ->check(CLI::Range(0.0, 100.0))
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
                    "Write beams without echo as points at (0, 0, 0), as many drivers do");
  command
      ->add_option("--frames", options->frames,
                   fmt::format("Scans, 1 to 100000; every {} a new world", drive_length))
      ->check(CLI::Range(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Which worlds; the same seed gives the same bytes")
      ->check(CLI::NonNegativeNumber)  // else -1 would wrap around
      ->type_name("N")
      ->capture_default_str();
  command
      ->add_option("-o,--output", options->output,
                   "Folder for sequences/NN with velodyne, labels, ground, echoes; made if missing")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--sequence", options->sequence,
                   "Two digits, so that one folder can hold several sequences")
      ->type_name("NN")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Scans worked on at once. Default: all cores")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace flagstone::cli

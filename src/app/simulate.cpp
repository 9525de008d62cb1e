// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "app/simulated_sequence.hpp"
#include "files/io/sensor_file.hpp"
#include "flagstone/sensor.hpp"
#include "lab/sim/alignment.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/extent.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/pose_noise.hpp"
#include "lab/sim/ray_caster.hpp"
#include "lab/sim/scene.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::app {
namespace {

/// An error that lists the names of `all` and suggests the closest one.
std::invalid_argument unknown_name(std::string_view option, std::string_view kind,
                                   std::string_view name, const auto& all) {
  std::vector<std::string_view> names;
  for (const auto& each : all) names.push_back(each.name);
  return std::invalid_argument(fmt::format("{}: {}", option, no_such(kind, name, names)));
}

const sim::SceneKind& scene_named(const std::string& name) {
  if (const sim::SceneKind* scene = sim::find_scene_kind(name)) return *scene;
  throw unknown_name("--scene", "scene", name, sim::scene_kinds());
}

// SemanticKITTI directories have two digits.
void check_sequence(const std::string& name) {
  const bool digits =
      std::ranges::all_of(name, [](char letter) { return letter >= '0' && letter <= '9'; });
  if (name.size() != 2 || !digits) {
    throw std::invalid_argument(
        fmt::format("--sequence: '{}' is not a sequence (expected two digits, 00 to 99)", name));
  }
}

sim::Mounting mounting_of(const SimulateOptions& options, const Sensor& sensor) {
  sim::Mounting mounting{.height = sensor.height};
  if (options.sensor_height) mounting.height = *options.sensor_height;
  const bool is_allowed = mounting.height >= 0 && mounting.height <= max_simulated_height;
  if (!is_allowed) {  // out of range, or NaN
    throw std::invalid_argument(
        fmt::format("--sensor-height: {} is out of range (expected 0 to {} m)", mounting.height,
                    max_simulated_height));
  }
  constexpr double most = max_simulated_tilt;
  const std::string& text = options.tilt;
  const char* end = text.data() + text.size();
  const auto [comma, bad_pitch] = std::from_chars(text.data(), end, mounting.pitch);
  const bool has_roll = bad_pitch == std::errc() && comma != end && *comma == ',';
  const auto [rest, bad_roll] = std::from_chars(has_roll ? comma + 1 : end, end, mounting.roll);
  if (!has_roll || bad_roll != std::errc() || rest != end || !(std::abs(mounting.pitch) <= most) ||
      !(std::abs(mounting.roll) <= most)) {
    throw std::invalid_argument(fmt::format(
        "--tilt: '{}' is not PITCH,ROLL (expected two angles in degrees, -90 to 90, e.g. 15,-5)",
        text));
  }
  return mounting;
}

void check_range(std::string_view option, double value, double minimum, double maximum,
                 std::string_view unit) {
  if (value >= minimum && value <= maximum) return;  // false for NaN
  throw std::invalid_argument(fmt::format("{}: {} is out of range (expected {} to {} {})", option,
                                          value, minimum, maximum, unit));
}

Sensor sensor_found(const std::string& name_or_file) {
  Sensor sensor;
  if (const Status status = io::find_sensor(name_or_file, sensor); !status.ok()) {
    throw std::invalid_argument(fmt::format("--sensor: {}", status.message()));
  }
  return sensor;
}

/// The environment of at least `length` metres, in whole stretches.
sim::Extent extent_of(const SimulateOptions& options, const sim::SceneKind& scene) {
  const double shortest = options.loop ? sim::shortest_circuit : sim::stretch_length;
  check_range("--length", options.length, shortest, max_length,
              options.loop ? "m with --loop" : "m");
  constexpr double rounding = 1e-9;
  const sim::Extent extent{.stretches = static_cast<std::size_t>(
                               std::ceil(options.length / sim::stretch_length - rounding)),
                           .closed = options.loop};
  if (extent.is_long() && scene.make_long == nullptr) {
    std::string names;
    for (const sim::SceneKind& kind : sim::scene_kinds()) {
      if (kind.make_long != nullptr) names += fmt::format(", {}", kind.name);
    }
    throw std::invalid_argument(
        fmt::format("--length: {} is always {} m long (expected one of these scenes: {})",
                    scene.name, sim::stretch_length, names.substr(2)));
  }
  return extent;
}

SequenceOrigin origin_of(const SimulateOptions& options, const sim::SceneKind& scene) {
  const Sensor sensor = sensor_found(options.sensor);
  const sim::NoiseLevel* level = sim::find_noise_level(options.noise);
  if (level == nullptr) {
    throw unknown_name("--noise", "noise level", options.noise, sim::noise_levels());
  }
  sim::Noise noise = level->noise;
  for (const std::string& name : options.weather) {
    const sim::Weather* weather = sim::find_weather(name);
    if (weather == nullptr) throw unknown_name("--weather", "weather", name, sim::weathers());
    weather->add_to(noise);
  }
  if (sim::find_pose_noise(options.pose_noise) == nullptr) {
    throw unknown_name("--pose-noise", "pose noise", options.pose_noise, sim::pose_noises());
  }
  check_range("--rate", options.pace.rate, min_rate, max_rate, "scans per second");
  check_range("--speed", options.pace.speed, min_speed, max_speed, "m/s");
  return {.scene = options.scene,
          .sensor = sensor,
          .mounting = mounting_of(options, sensor),
          .noise_name = options.noise,
          .weather = options.weather,
          .noise = noise,
          .keep_no_returns = options.keep_no_returns,
          .pace = options.pace,
          .extent = extent_of(options, scene),
          .pose_noise = options.pose_noise,
          .seed = options.seed,
          .frames = options.frames};
}

/// Simulates the missing frames of a sequence on several threads. A frame depends only on the
/// origin and its number.
class SequenceRun {
 public:
  SequenceRun(const SimulatedSequence& files, const sim::SceneKind& scene,
              const SequenceOrigin& origin)
      : files_(files),
        scene_(scene),
        origin_(origin),
        drive_length_(origin.pace.frames(origin.extent)),
        worlds_((origin.frames + drive_length_ - 1) / drive_length_) {
    for (World& world : worlds_) {
      world.parts = std::vector<Part>(sim::Drive::part_count(origin.extent));
    }
    for (std::size_t frame = 0; frame < origin.frames; ++frame) {
      if (files.has(frame)) continue;
      missing_.push_back(frame);
      World& world = worlds_[frame / drive_length_];
      ++world.frames_left;
      for (Part& part : parts_of(world, frame % drive_length_)) ++part.frames_left;
    }
  }

  [[nodiscard]] std::size_t missing() const noexcept { return missing_.size(); }
  [[nodiscard]] std::size_t environments() const noexcept { return worlds_.size(); }

  RunOutcome run(unsigned threads, const RunCallbacks& callbacks) {
    // Each thread starts with a different environment, so that they are built in parallel. All
    // threads share the last environments.
    const std::size_t side_by_side = threads_or_cores(threads);
    std::ranges::sort(missing_, {}, [&](std::size_t frame) {
      const std::size_t drive = frame / drive_length_;
      return std::tuple(drive / side_by_side, frame % drive_length_, drive);
    });
    return run_in_order(
        missing_.size(), threads, "scans", callbacks,
        [&] {
          return [&](std::size_t job) {
            simulate(missing_[job]);
            return true;
          };
        },
        [](std::size_t, bool) {});
  }

  /// Pose of the sensor in its environment, for every frame, exact and as an odometry measures it.
  struct Poses {
    std::vector<sim::Frame> exact, measured;
  };
  [[nodiscard]] Poses poses() const {
    const sim::PoseNoise& noise = *sim::find_pose_noise(origin_.pose_noise);
    Poses poses;
    for (std::size_t index = 0; index < worlds_.size(); ++index) {
      const std::vector<sim::Frame> exact = drive(index).poses();
      const std::vector<sim::Frame> measured =
          measured_poses(exact, noise, sim::drive_seed(origin_.seed, index));
      poses.exact.insert(poses.exact.end(), exact.begin(), exact.end());
      poses.measured.insert(poses.measured.end(), measured.begin(), measured.end());
    }
    poses.exact.resize(origin_.frames);
    poses.measured.resize(origin_.frames);
    return poses;
  }

 private:
  /// A part of an environment: built by the first thread that needs it, freed after the last frame
  /// that does.
  struct Part {
    std::once_flag built;
    std::shared_ptr<const sim::RayCaster> caster;
    std::atomic<std::size_t> frames_left = 0;
  };

  /// An environment of a sequence, made and freed in the same way.
  struct World {
    std::once_flag made;
    std::unique_ptr<sim::Drive> drive;
    std::vector<Part> parts;
    std::atomic<std::size_t> frames_left = 0;
  };

  /// The parts that a frame of an environment needs.
  [[nodiscard]] std::span<Part> parts_of(World& world, std::size_t number) const {
    const auto [first, count] = sim::Drive::parts_of(number, origin_.pace, origin_.extent);
    return std::span(world.parts).subspan(first, count);
  }

  [[nodiscard]] sim::Drive drive(std::size_t index) const {
    return {scene_,       origin_.sensor, origin_.mounting, sim::drive_seed(origin_.seed, index),
            origin_.pace, origin_.extent};
  }

  void simulate(std::size_t frame) {
    World& world = worlds_[frame / drive_length_];
    std::call_once(world.made, [&] {
      world.drive = std::make_unique<sim::Drive>(drive(frame / drive_length_));
    });
    const std::span<Part> parts = parts_of(world, frame % drive_length_);
    std::vector<std::shared_ptr<const sim::RayCaster>> casters;
    for (Part& part : parts) {
      std::call_once(part.built, [&] {
        part.caster = world.drive->part(static_cast<std::size_t>(&part - world.parts.data()));
      });
      casters.push_back(part.caster);
    }
    const int number = static_cast<int>(frame % drive_length_);
    const sim::SimulatedScan scan = world.drive->scan(
        world.drive->scene(std::move(casters)), origin_.noise, number, origin_.keep_no_returns);
    files_.write(frame, scan, world.drive->ground_of(scan, number), world.drive->times_of(scan));
    for (Part& part : parts) {
      if (--part.frames_left == 0) part.caster.reset();
    }
    if (--world.frames_left == 0) world.drive.reset();
  }

  const SimulatedSequence& files_;
  const sim::SceneKind& scene_;
  const SequenceOrigin& origin_;
  std::size_t drive_length_;   // frames per environment
  std::vector<World> worlds_;  // by index of the environment
  std::vector<std::size_t> missing_;
};

}  // namespace

Simulation simulate(const SimulateOptions& options, const RunCallbacks& callbacks) {
  const sim::SceneKind& scene = scene_named(options.scene);
  check_sequence(options.sequence);
  if (options.frames < 1 || options.frames > max_frames) {
    throw std::invalid_argument(
        fmt::format("--frames: {} is out of range (expected 1 to {})", options.frames, max_frames));
  }
  const SimulatedSequence files(
      std::filesystem::path(options.output) / "sequences" / options.sequence,
      options.pace.distortion);
  const SequenceOrigin origin = origin_of(options, scene);
  files.begin(origin);

  SequenceRun sequence(files, scene, origin);
  const RunOutcome run = sequence.run(options.threads, callbacks);
  Simulation simulation{.folder = files.folder(),
                        .sensor = origin.sensor.name,
                        .drives = sequence.environments(),
                        .frames_per_environment = origin.pace.frames(origin.extent),
                        .simulated = run.done,
                        .kept = options.frames - sequence.missing(),
                        .interrupted = run.done < sequence.missing()};
  if (simulation.interrupted) {
    callbacks.say(
        fmt::format("interrupted: {} of {} frames are done (run the command again for all)",
                    simulation.kept + simulation.simulated, options.frames));
  } else {
    const SequenceRun::Poses poses = sequence.poses();
    files.write_poses("poses.txt", poses.exact);
    files.write_times(options.frames, options.pace.rate);
    if (options.pose_noise != "none") files.write_poses("poses_measured.txt", poses.measured);
  }
  return simulation;
}

}  // namespace flagstone::app

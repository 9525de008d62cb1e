// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/config/settings_json.hpp"
#include "app/mapping/map_outputs.hpp"
#include "app/mapping/map_run.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/python_command.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {
namespace {

/// Instead of a file of poses.
constexpr const char* kiss_icp = "kiss-icp";

struct MapOptions {
  std::string run, poses, output;
  config::MethodChoice method;
  int columns = 0;
  app::LabelSource labels = app::LabelSource::offline;
  double delay = 2;
  std::optional<double> rate;
  bool heights = false;
  double voxel = 0.2;
  std::size_t map_memory = 1000;
  unsigned threads = 0;
  bool json = false;
  std::string topic, pose_topic;
  bool geotiff = false;
  std::string crs;
  bool las = false;
  bool recording = false;
  bool animation = false;

  [[nodiscard]] bool finds_poses() const { return poses == kiss_icp; }
  /// Whether scans or poses are not files yet.
  [[nodiscard]] bool needs_input() const { return finds_poses() || is_bag(run) || is_bag(poses); }
  [[nodiscard]] bool exports() const { return geotiff || las || recording || animation; }
};

app::MapRequest request_of(const MapOptions& options) {
  app::MapRequest request{.run = options.run,
                          .poses = options.poses,
                          .output = options.output,
                          .method = config::resolve_one(options.method),
                          .read = {.columns = options.columns},
                          .labels = options.labels,
                          .delay = options.delay,
                          .rate = options.rate,
                          .heights = options.heights,
                          .voxel = options.voxel,
                          .map_memory = options.map_memory,
                          .threads = options.threads};
  for (const std::string& file : {options.method.config_file, options.method.sensor}) {
    if (!file.empty()) request.settings_files.emplace_back(file);
  }
  return request;
}

void check_python_options(const MapOptions& options) {
  const auto check = [](const std::string& topic, const char* option, const std::string& path) {
    if (topic.empty() || is_bag(path)) return;
    throw std::invalid_argument(
        fmt::format("{}: {} is not a bag (expected a bag)", option, io::printable(path)));
  };
  check(options.topic, "--topic", options.run);
  check(options.pose_topic, "--pose-topic", options.poses);
  if (options.las && options.voxel == 0) {
    throw std::invalid_argument("--las: needs the static points (expected --voxel above 0)");
  }
}

/// The optional dependencies that the options need, for messages.
std::string_view extra_of(const MapOptions& options) {
  if (options.finds_poses()) return "odometry";
  if (options.needs_input()) return "bag";
  if (options.geotiff) return "geotiff";
  if (options.las) return "las";
  return options.recording ? "viewer" : "plot";
}

/// Runs a part of the work in Python: before the run is mapped, "prepare"; afterwards, "export".
/// Returns its exit code.
int run_part(const char* part, const MapOptions& options, const app::MapRequest& request) {
  return call_python("map",
                     {{"part", part},
                      {"method", request.method.name},
                      {"settings", nlohmann::ordered_json::parse(config::to_json(request.method))},
                      {"columns", options.columns},
                      {"topic", options.topic},
                      {"pose_topic", options.pose_topic},
                      {"geotiff", options.geotiff},
                      {"crs", options.crs},
                      {"las", options.las},
                      {"recording", options.recording},
                      {"animation", options.animation},
                      {"json", options.json}},
                     {options.run, options.poses, options.output}, extra_of(options));
}

void print_text(const MapOptions& options, const app::MapOutcome& outcome) {
  fmt::print("{} scans: {} mapped, {} labelled alone, {} failed\n", outcome.scans, outcome.mapped,
             outcome.alone, outcome.failed);
  fmt::print("{:.0f} m of path, {:.0f} m2 of ground, {} moving points\n", outcome.path,
             outcome.area, outcome.moving_points);
  if (options.voxel > 0) fmt::print("{} static points\n", outcome.static_points);
  fmt::print("{:.1f} s, {:.1f} scans per second; map {:.1f} MB, votes {:.1f} MB\n", outcome.seconds,
             static_cast<double>(outcome.scans) / outcome.seconds,
             static_cast<double>(outcome.map_bytes) / 1e6,
             static_cast<double>(outcome.vote_bytes) / 1e6);
  fmt::print("{}\n", io::printable(options.output));
}

void print_json(const app::MapOutcome& outcome) {
  const nlohmann::ordered_json line = {{"scans", outcome.scans},
                                       {"mapped", outcome.mapped},
                                       {"alone", outcome.alone},
                                       {"failed", outcome.failed},
                                       {"path", outcome.path},
                                       {"area", outcome.area},
                                       {"moving_points", outcome.moving_points},
                                       {"static_points", outcome.static_points},
                                       {"map_bytes", outcome.map_bytes},
                                       {"vote_bytes", outcome.vote_bytes},
                                       {"seconds", outcome.seconds},
                                       {"problems", outcome.problems}};
  using Handler = nlohmann::ordered_json::error_handler_t;
  fmt::print("{}\n", line.dump(-1, ' ', false, Handler::replace));
}

class MapCommand final : public Command {
 public:
  using Command::Command;
  MapOptions options;

  int run() override {
    catch_interrupts();
    check_python_options(options);
    app::MapRequest request = request_of(options);
    if (options.needs_input() || options.exports()) {
      app::check_map_request(request);
      if (const int code = run_part("prepare", options, request); code != 0) return code;
      const app::MapOutputs files{.directory = options.output};
      if (is_bag(options.run)) request.run = files.input();
      if (options.finds_poses() || is_bag(options.poses)) request.poses = files.input_poses();
    }
    ProgressBar bar;
    const app::MapOutcome outcome =
        app::map_run(request, {.run = bar.callbacks(), .mount = [&](const app::FoundMount& found) {
                                 if (!options.json) fmt::print("{}\n", app::to_text(found));
                               }});
    bar.clear();
    if (outcome.interrupted) {
      print_error("interrupted: the map is not finished (run the command again)");
      return 1;
    }
    if (options.json) {
      print_json(outcome);
    } else {
      print_text(options, outcome);
    }
    const int code = options.exports() ? run_part("export", options, request) : 0;
    return outcome.failed == 0 ? code : 1;
  }
};

void add_label_options(CLI::App& command, MapOptions& options) {
  using app::LabelSource;
  command.option_defaults()->group(output_group);
  add_choice_option<LabelSource>(command, "--labels", "kind of labels",
                                 {{"live", LabelSource::live},
                                  {"delayed", LabelSource::delayed},
                                  {"offline", LabelSource::offline}},
                                 options.labels,
                                 "Scans that determine the labels and the moving points of a scan"
                                 "\nlive\tthe scans before it, as on a robot"
                                 "\ndelayed\talso the scans of --delay seconds after it"
                                 "\noffline\tall scans of the run")
      ->default_str("offline")
      ->type_name("KIND");
  command.add_option("--delay", options.delay, "Delay of --labels delayed in seconds, 0 to 10")
      ->check(in_range(0.0, 10.0))
      ->capture_default_str()
      ->type_name("S");
  command.add_flag("--heights", options.heights,
                   "Write the height of each point above the ground to heights/NAME.heights.npy");
  command
      .add_option("--voxel", options.voxel,
                  "Voxel size of static.ply in metres; 0: do not write this cloud")
      ->capture_default_str()
      ->type_name("M");
  command
      .add_option("--map-memory", options.map_memory,
                  "Memory of the map in megabytes, beyond which its tiles are kept in files; 0: no "
                  "limit")
      ->capture_default_str()
      ->type_name("MB");
}

void add_export_options(CLI::App& command, MapOptions& options) {
  CLI::Option* const geotiff =
      command.add_flag("--geotiff", options.geotiff, "Write the map as ground.tif");
  command
      .add_option("--crs", options.crs,
                  "Coordinate reference system of the poses, for ground.tif: EPSG:25832 and so on")
      ->needs(geotiff)
      ->type_name("CRS");
  command.add_flag("--las", options.las, "Write the static points as static.las");
  command.add_flag("--recording", options.recording, "Write recording.rrd for the viewer of Rerun");
  command.add_flag("--animation", options.animation,
                   "Write animation.gif: the ground growing scan by scan");
}

}  // namespace

std::unique_ptr<Command> add_map_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "map", "Map the ground of a run, improve its labels and find the points that move.");
  set_help(*command,
           {.examples = {{"flagstone map sequences/05 --poses sequences/05/poses.txt --output map",
                          "labels, moving points, ground and static cloud of a run"},
                         {"flagstone map scans/ --poses odometry.tum -o map --labels delayed",
                          "labels as a robot would have them 2 s later"},
                         {"flagstone map street.mcap --poses street.mcap -o map --geotiff",
                          "a run and its odometry in one bag, and a map for a GIS"}},
            .notes = "A scan without a usable pose is labelled alone. Every such decision is "
                     "reported in one line.",
            .exit_codes = "0, success; 1, some scans failed, or the output was not finished; 2, "
                          "usage error."});
  auto made = std::make_unique<MapCommand>(*command);
  MapOptions* const options = &made->options;
  command
      ->add_option("run", options->run,
                   "Directory with the scans of a run, or with 'velodyne'; or a bag")
      ->required()
      ->type_name("RUN");
  command->option_defaults()->group(input_group);
  command
      ->add_option("--poses", options->poses,
                   "Poses of the sensor: a file (KITTI, with calib.txt if they are of the camera, "
                   "TUM or CSV); a bag with odometry or transforms; or 'kiss-icp', which finds "
                   "them from the scans")
      ->required()
      ->type_name("POSES");
  command->add_option("--topic", options->topic, "Point cloud topic, if RUN is a bag")
      ->default_str("the only one in the bag")
      ->type_name("TOPIC");
  command
      ->add_option("--pose-topic", options->pose_topic,
                   "Topic of the poses, if they are in a bag: odometry, poses, /tf, or /tf:FRAME "
                   "for poses in that frame")
      ->default_str("the only one of odometry, of poses, or /tf")
      ->type_name("TOPIC");
  command
      ->add_option("--rate", options->rate,
                   "Scans per second, if no file contains the times of the scans")
      ->default_str("times.txt, or the times of the poses; otherwise 10")
      ->type_name("HZ");
  add_columns_option(*command, options->columns);
  add_method_options(*command, options->method);
  command->option_defaults()->group(output_group);
  command
      ->add_option("-o,--output", options->output, "Output directory, created if it does not exist")
      ->required()
      ->type_name("DIR");
  add_label_options(*command, *options);
  add_export_options(*command, *options);
  command->add_flag("--json", options->json, "Print the result as a JSON object");
  add_threads_option(*command, options->threads, "all cores");
  return made;
}

}  // namespace flagstone::cli

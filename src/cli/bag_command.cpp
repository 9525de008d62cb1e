// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/config/settings_json.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/python_command.hpp"
#include "cli/shared_options.hpp"

namespace flagstone::cli {
namespace {

struct BagOptions {
  std::string in;
  std::string out;
  std::vector<std::string> topics;
  std::string sensor_frame;
  std::string imu;
  config::MethodChoice method;
  std::string format = "labelled";
  unsigned threads = 0;
  bool json = false;
};

class BagCommand final : public Command {
 public:
  using Command::Command;
  BagOptions options;

  int run() override {
    const config::ResolvedMethod method = config::resolve_one(options.method);
    config::check_threads(method.mount, options.threads);
    run_in_python("bag",
                  {{"method", method.name},
                   {"settings", nlohmann::ordered_json::parse(config::to_json(method))},
                   {"topics", options.topics},
                   {"sensor_frame", options.sensor_frame},
                   {"imu", options.imu},
                   {"format", options.format},
                   {"threads", options.threads},
                   {"json", options.json}},
                  {options.in, options.out});
  }
};

void add_input_options(CLI::App& command, BagOptions& options) {
  command.option_defaults()->group(input_group);
  command.add_option("--topic", options.topics, "Point cloud topic to label")
      ->default_str("the only one in the bag")
      ->allow_extra_args(false)
      ->type_name("TOPIC");
  command
      .add_option("--tf", options.sensor_frame,
                  "Frame of the sensor, if the clouds are in another frame; /tf_static must "
                  "contain the transform")
      ->type_name("FRAME");
  command
      .add_option("--imu", options.imu,
                  "Topic of sensor_msgs/Imu, whose acceleration determines the up direction of "
                  "each scan")
      ->type_name("TOPIC");
}

}  // namespace

std::unique_ptr<Command> add_bag_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "bag", "Copy a bag of ROS 1 or ROS 2 and add labelled point clouds to it.");
  set_help(*command,
           {.examples = {{"flagstone bag street.mcap labelled.mcap",
                          "add /points/labelled, with the fields 'label' and 'height'"},
                         {"flagstone bag street.bag split.bag --format split",
                          "add /points/ground and /points/nonground"},
                         {"flagstone bag street/ labelled/ --topic /top/points --tf top_lidar",
                          "label clouds that the driver transformed to another frame"}},
            .notes = "All messages of the bag are copied unchanged. Each added message follows "
                     "its cloud, with the same times and header. 'flagstone info BAG' lists the "
                     "topics.",
            .exit_codes = "0, success; 1, some clouds failed, or OUT was not written; 2, usage "
                          "error."});
  auto made = std::make_unique<BagCommand>(*command);
  BagOptions* const options = &made->options;
  command
      ->add_option("in", options->in,
                   "Bag to read: .bag, .mcap or .db3, or a directory with metadata.yaml")
      ->required()
      ->type_name("IN");
  command
      ->add_option("out", options->out, "Bag to create: .bag, .mcap or .db3, otherwise a directory")
      ->required()
      ->type_name("OUT");
  add_input_options(*command, *options);
  add_method_options(*command, options->method);
  command->get_option("--imu")->excludes(command->get_option("--tilt"));
  command->option_defaults()->group(output_group);
  add_choice_option<std::string>(
      *command, "--format", "format",
      {{"labelled", "labelled"}, {"split", "split"}, {"both", "both"}}, options->format,
      "Topics to add"
      "\nlabelled\tTOPIC/labelled: all points with added fields 'label' and 'height'"
      "\nsplit\tTOPIC/ground and TOPIC/nonground, with an added field 'height'"
      "\nboth\tall three")
      ->default_str("labelled")
      ->type_name("FORMAT");
  command->add_flag("--json", options->json, "Print one JSON object per scan instead of text");
  add_threads_option(*command, options->threads, "all cores; 1 with --sensor-height track");
  return made;
}

}  // namespace flagstone::cli

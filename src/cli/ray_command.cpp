// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/config/settings_json.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/python_command.hpp"
#include "cli/shared_options.hpp"

namespace flagstone::cli {
namespace {

struct RayOptions {
  std::string source;
  std::string output;
  bool in_place = false;
  config::MethodChoice method;
  int columns = 0;
  std::string format = "label";
  std::string label_map = "flagstone";
  bool overwrite = false;
  std::string address;
  int workers = 0;
};

class RayCommand final : public Command {
 public:
  using Command::Command;
  RayOptions options;

  int run() override {
    if (options.output.empty() && !options.in_place) {
      throw std::invalid_argument(
          "ray: --output DIR is missing (or --in-place; see 'flagstone ray --help')");
    }
    const config::ResolvedMethod method = config::resolve_one(options.method);
    run_in_python("ray",
                  {{"method", method.name},
                   {"settings", nlohmann::ordered_json::parse(config::to_json(method))},
                   {"columns", options.columns},
                   {"format", options.format},
                   {"label_map", options.label_map},
                   {"overwrite", options.overwrite},
                   {"address", options.address},
                   {"workers", options.workers}},
                  {options.source, options.output});
  }
};

void add_output_options(CLI::App& command, RayOptions& options) {
  command.option_defaults()->group(output_group);
  CLI::Option* const output =
      command
          .add_option("-o,--output", options.output,
                      "Directory or URL for the labels, with the subdirectories of the source")
          ->type_name("DIR");
  command.add_flag("--in-place", options.in_place, "Write the labels next to the scans")
      ->excludes(output);
  add_choice_option<std::string>(command, "--format", "format", {{"label", "label"}, {"u8", "u8"}},
                                 options.format,
                                 "Output format"
                                 "\nlabel\tone uint32 per point"
                                 "\nu8\tone uint8 per point, as a NumPy array")
      ->default_str("label")
      ->type_name("FORMAT");
  add_choice_option<std::string>(command, "--label-map", "label map",
                                 {{"flagstone", "flagstone"}, {"semantic-kitti", "semantic-kitti"}},
                                 options.label_map,
                                 "Codes in label files"
                                 "\nflagstone\t0 to 4, one per label"
                                 "\nsemantic-kitti\t40 for ground, otherwise 0")
      ->default_str("flagstone");
  command.add_flag("--overwrite", options.overwrite,
                   "Label all scans again, including finished ones");
}

void add_cluster_options(CLI::App& command, RayOptions& options) {
  constexpr int most_workers = 100'000;
  command.option_defaults()->group("Cluster");
  command.add_option("--address", options.address, "Ray cluster to join")
      ->default_str("RAY_ADDRESS, otherwise Ray is started on this machine")
      ->type_name("ADDRESS");
  command.add_option("--workers", options.workers, "Number of cores to use, 1 to 100000")
      ->check(in_range(1, most_workers))
      ->default_str("all")
      ->type_name("N");
}

}  // namespace

std::unique_ptr<Command> add_ray_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("ray", "Label all scans of a directory or bucket, also on a Ray cluster.");
  set_help(
      *command,
      {.examples = {{"flagstone ray scans/ --output labels/"},
                    {"flagstone ray s3://bucket/scans --output s3://bucket/labels --address auto"},
                    {"flagstone ray scans/ --in-place --method patchwork --sensor hdl-32e"}},
       .notes = "Run the same command again to resume an interrupted run or to retry failed "
                "scans."});
  auto made = std::make_unique<RayCommand>(*command);
  RayOptions* const options = &made->options;
  command
      ->add_option("source", options->source,
                   "Directory of scans, or one scan: a path, or a URL such as s3://bucket/scans")
      ->required()
      ->type_name("SOURCE");
  add_columns_option(*command, options->columns);
  add_method_options(*command, options->method);
  add_output_options(*command, *options);
  add_cluster_options(*command, *options);
  return made;
}

}  // namespace flagstone::cli

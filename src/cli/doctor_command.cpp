// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/config/settings_json.hpp"
#include "app/doctor_report.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/python_command.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"

namespace flagstone::cli {
namespace {

struct DoctorOptions {
  std::vector<std::string> scans;
  std::size_t max_scans = 5;
  std::string output;
  config::MethodChoice method;
  std::string topic;
  int columns = 0;
  bool json = false;
  bool toml = false;
};

/// Python reads the clouds and examines them with the same code.
[[noreturn]] void examine_bags(const DoctorOptions& options, const config::ResolvedMethod& method) {
  app::OutputPlan plan;
  plan.reads_settings(options.method.config_file, options.method.sensor);
  for (const std::string& bag : options.scans) {
    if (std::filesystem::is_directory(bag)) {
      plan.reads_dataset(bag);
    } else {
      plan.reads(bag);
    }
  }
  plan.writes(options.output);
  plan.check();
  std::vector<std::string> paths = {options.output};
  paths.insert(paths.end(), options.scans.begin(), options.scans.end());
  run_in_python("doctor",
                {{"method", method.name},
                 {"settings", nlohmann::ordered_json::parse(config::to_json(method))},
                 {"topic", options.topic},
                 {"max_scans", options.max_scans},
                 {"json", options.json},
                 {"toml", options.toml}},
                paths);
}

class DoctorCommand final : public Command {
 public:
  using Command::Command;
  DoctorOptions options;

  int run() override {
    config::ResolvedMethod method = config::resolve_one(options.method);
    if (are_bags(options.scans)) examine_bags(options, method);
    app::DoctorRequest request{.scans = options.scans,
                               .max_scans = options.max_scans,
                               .method = method.name,
                               .config = std::move(method.config),
                               .columns = options.columns,
                               .output = options.output};
    request.plan.reads_settings(options.method.config_file, options.method.sensor);
    catch_interrupts();
    ProgressBar bar;
    const app::DoctorReport report = app::examine_files(request, bar.callbacks());
    bar.clear();
    if (report.interrupted) {
      print_error("interrupted: no scan was diagnosed (a smaller --max-scans takes less time)");
      return 1;
    }
    if (options.json) {
      fmt::print("{}", app::json_of(report));
    } else if (!report.files.empty()) {
      if (!options.toml) {
        fmt::print("{}", app::text_of(report, ::isatty(STDOUT_FILENO) != 0));
        if (options.output.empty()) fmt::print("\n");
      }
      if (options.output.empty()) fmt::print("{}", app::toml_of(report));
    }
    return report.ok() ? 0 : 1;
  }
};

}  // namespace

std::unique_ptr<Command> add_doctor_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "doctor", "Check scans for common problems and print settings that fix them.");
  set_help(*command,
           {.examples = {{"flagstone doctor scans/ --output doctor.toml"},
                         {"flagstone doctor street.mcap --output doctor.toml"},
                         {"flagstone segment scans/ --output labels --config doctor.toml"}},
            .notes = "The doctor detects wrong units or axes, a tilted sensor, an origin on the "
                     "ground, a wrong sensor height, missing returns and points on the ego "
                     "vehicle, among others.",
            .exit_codes = "0, no problem found; 1, a problem was found or a scan cannot be read; "
                          "2, usage error."});
  auto made = std::make_unique<DoctorCommand>(*command);
  DoctorOptions* const options = &made->options;
  add_scans_option(*command, options->scans,
                   "Scan files, or directories to search for scans (.bin, .pcd.bin, .pcd, .ply, "
                   ".npy); or bags (.bag, .mcap, .db3, directories with metadata.yaml)");
  command
      ->add_option("--max-scans", options->max_scans,
                   "Number of scans to examine per directory or bag, evenly spaced")
      ->check(in_range(1, 1000000))
      ->capture_default_str()
      ->type_name("N")
      ->group(input_group);
  add_columns_option(*command, options->columns);
  command->add_option("--topic", options->topic, "Point cloud topic of a bag")
      ->default_str("the only one in the bag")
      ->type_name("TOPIC")
      ->group(input_group);
  add_method_options(*command, options->method);

  command->option_defaults()->group(output_group);
  command
      ->add_option("-o,--output", options->output,
                   "Write the recommended settings to this file, for --config")
      ->type_name("FILE");
  CLI::Option* const json =
      command->add_flag("--json", options->json, "Print one JSON object instead of text");
  command->add_flag("--toml", options->toml, "Print only the recommended settings")->excludes(json);
  return made;
}

}  // namespace flagstone::cli

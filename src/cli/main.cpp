// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/terminal.hpp"
#include "cli/usage_error.hpp"
#include "flagstone/version.hpp"

namespace {

constexpr int usage_error = 2;

/// Adds the commands, in the groups and the order in which --help lists them.
std::vector<std::unique_ptr<flagstone::cli::Command>> add_commands(CLI::App& app) {
  using namespace flagstone::cli;
  std::vector<std::unique_ptr<Command>> commands;
  const auto add_group = [&](const char* name, auto... add) {
    const std::size_t first = app.get_subcommands({}).size();
    (commands.push_back(add(app)), ...);
    const std::vector<CLI::App*> all = app.get_subcommands([](CLI::App*) { return true; });
    for (std::size_t i = first; i < all.size(); ++i) all[i]->group(name);
  };
  add_group("Segment scans", add_segment_command, add_map_command, add_bag_command, add_ray_command,
            add_doctor_command, add_info_command);
  add_group("Measure accuracy and speed", add_eval_command, add_sweep_command, add_bench_command);
  add_group("Simulate scans", add_demo_command, add_simulate_command);
  add_group("Settings", add_config_command, add_sensors_command);
  add_group("Install", add_completion_command, add_manual_command);
  return commands;
}

constexpr const char* unwritable = "standard output: cannot be written (is the disk full?)";

int run(int argc, char** argv) {
  using namespace flagstone::cli;
  CLI::App app("Ground segmentation for 3D LiDAR: labels, heights and the ground surface.",
               "flagstone");
  app.option_defaults()->group(other_group);
  app.set_version_flag("--version", FLAGSTONE_VERSION, "Show the version");
  app.require_subcommand(1);
  const std::vector<std::unique_ptr<Command>> commands = add_commands(app);
  set_help(
      app,
      {.examples = {{"flagstone demo", "try it on a simulated street"},
                    {"flagstone doctor scans/", "find settings for your sensor"},
                    {"flagstone segment scans/ --output labels", "label the points of your scans"}},
       .notes = "'flagstone COMMAND --help' shows the options of a command."});
  if (argc > 1) check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    print_error(usage_message(app, error));
    return usage_error;
  }
  int exit_code = 0;
  for (const auto& command : commands) {
    if (command->parser().parsed()) exit_code = command->run();
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) throw std::runtime_error(unwritable);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A file-size limit then makes write() fail, and temporary files are removed.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    flagstone::cli::print_error(error.what());
    return usage_error;
  } catch (const std::exception& error) {
    // fmt::print throws its own message if standard output is full.
    flagstone::cli::print_error(std::ferror(stdout) != 0 ? unwritable : error.what());
    return 1;
  }
}

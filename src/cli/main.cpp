// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "cli/bench_command.hpp"
#include "cli/config_command.hpp"
#include "cli/demo_command.hpp"
#include "cli/doctor_command.hpp"
#include "cli/eval_command.hpp"
#include "cli/info_command.hpp"
#include "cli/print_error.hpp"
#include "cli/segment_command.hpp"
#include "cli/sensors_command.hpp"
#include "cli/simulate_command.hpp"
#include "cli/sweep_command.hpp"
#include "flagstone/version.hpp"

namespace {

constexpr int wrong_usage = 2;

/// Lists commands by the first line of what they say of themselves; their own help says the rest.
class BriefListing : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App* command) const override {
    const std::string description = command->get_description();
    return fmt::format("  {:<{}}{}\n", command->get_name(), get_column_width() - 2,
                       description.substr(0, description.find('\n')));
  }
};

int run(int argc, char** argv) {
  CLI::App app(
      "Ground segmentation for 3D LiDAR.\n\n"
      "Example:  flagstone segment scan.bin --output out --image\n\n"
      "'flagstone COMMAND --help' explains a command.");
  app.set_version_flag("--version", FLAGSTONE_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<BriefListing>());
  int exit_code = 0;
  flagstone::cli::add_segment_command(app, exit_code);
  flagstone::cli::add_doctor_command(app, exit_code);
  flagstone::cli::add_simulate_command(app, exit_code);
  flagstone::cli::add_eval_command(app, exit_code);
  flagstone::cli::add_sweep_command(app, exit_code);
  flagstone::cli::add_bench_command(app, exit_code);
  flagstone::cli::add_demo_command(app, exit_code);
  flagstone::cli::add_info_command(app, exit_code);
  flagstone::cli::add_config_command(app, exit_code);
  flagstone::cli::add_sensors_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    flagstone::cli::print_error(fmt::format("{}; see 'flagstone --help'", error.what()));
    return wrong_usage;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw std::runtime_error("standard output cannot be written");
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    flagstone::cli::print_error(error.what());
    return wrong_usage;
  } catch (const std::exception& error) {
    flagstone::cli::print_error(error.what());
    return 1;
  }
}

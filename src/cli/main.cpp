// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.hpp"
#include "cli/config_command.hpp"
#include "cli/eval_command.hpp"
#include "cli/sensors_command.hpp"
#include "cli/simulate_command.hpp"
#include "cli/sweep_command.hpp"
#include "cli/terminal.hpp"
#include "flagstone/version.hpp"
#include "library/core/did_you_mean.hpp"

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

/// Throws std::invalid_argument if the first word is neither an option nor a command.
void check_command(CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  const std::string_view nearest = flagstone::closest_name(word, known);
  throw std::invalid_argument(fmt::format("{}: is not a command ({}; see 'flagstone --help')", word,
                                          nearest.empty()
                                              ? fmt::format("expected {}", fmt::join(names, ", "))
                                              : fmt::format("did you mean {}?", nearest)));
}

int run(int argc, char** argv) {
  using namespace flagstone::cli;
  CLI::App app(
      "Ground segmentation for 3D LiDAR.\n\n"
      "Example:  flagstone segment scan.bin --output out --image\n\n"
      "'flagstone COMMAND --help' explains a command.");
  app.set_version_flag("--version", FLAGSTONE_VERSION);
  app.require_subcommand(1);
  app.formatter(std::make_shared<BriefListing>());
  int exit_code = 0;
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(add_segment_command(app));
  commands.push_back(add_doctor_command(app));
  add_simulate_command(app, exit_code);
  add_eval_command(app, exit_code);
  add_sweep_command(app, exit_code);
  commands.push_back(add_bench_command(app));
  commands.push_back(add_demo_command(app));
  commands.push_back(add_info_command(app));
  add_config_command(app, exit_code);
  add_sensors_command(app, exit_code);
  if (argc > 1) check_command(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    print_error(fmt::format("{}; see 'flagstone --help'", error.what()));
    return wrong_usage;
  }
  for (const auto& command : commands) {
    if (command->parser().parsed()) exit_code = command->run();
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw std::runtime_error("standard output cannot be written");
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A file-size limit is an error of write(), so that temporary files are removed.
  std::signal(SIGXFSZ, SIG_IGN);
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

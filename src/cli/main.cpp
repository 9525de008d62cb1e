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
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/commands.hpp"
#include "cli/config_command.hpp"
#include "cli/eval_command.hpp"
#include "cli/sensors_command.hpp"
#include "cli/simulate_command.hpp"
#include "cli/sweep_command.hpp"
#include "cli/terminal.hpp"
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

/// How many letters have to be inserted, removed or replaced to make one word of the other.
std::size_t edit_distance(std::string_view one, std::string_view other) {
  std::vector<std::size_t> row(other.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= one.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= other.size(); ++j) {
      const std::size_t replaced = diagonal + (one[i - 1] == other[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
    }
  }
  return row.back();
}

/// Throws std::invalid_argument if the first word is neither an option nor a command.
void check_command(CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands({})) {
    names.push_back(command->get_name());
  }
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return;
  const auto nearest = std::ranges::min_element(
      names, {}, [&](const std::string& name) { return edit_distance(word, name); });
  const bool is_near = edit_distance(word, *nearest) <= 2;
  throw std::invalid_argument(
      fmt::format("{}: is not a command ({}; see 'flagstone --help')", word,
                  is_near ? fmt::format("did you mean {}?", *nearest)
                          : fmt::format("expected {}", fmt::join(names, ", "))));
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

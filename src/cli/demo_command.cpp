// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstdio>
#include <memory>

#include "app/demo.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/shared_options.hpp"

namespace flagstone::cli {
namespace {

class DemoCommand final : public Command {
 public:
  using Command::Command;
  app::DemoRequest request;

  int run() override {
    fmt::print("Simulating a street with a 64-beam sensor (seed {}) ...\n\n", request.seed);
    std::fflush(stdout);
    fmt::print("{}", app::run_demo(request));
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_demo_command(CLI::App& parser) {
  CLI::App* command = parser.add_subcommand(
      "demo", "Simulate a street, segment it, score the labels and draw images.");
  set_help(*command, {.examples = {{"flagstone demo", "write to flagstone-demo/"},
                                   {"flagstone demo --output demo --seed 11", "another street"}},
                      .exit_codes = "0, success; 1, error; 2, usage error."});
  auto made = std::make_unique<DemoCommand>(*command);
  app::DemoRequest* const options = &made->request;
  command
      ->add_option("-o,--output", options->output, "Output directory, created if it does not exist")
      ->type_name("DIR")
      ->capture_default_str()
      ->group(output_group);
  add_seed_option(*command, options->seed,
                  "Random seed of the street; the output depends on nothing else");
  return made;
}

}  // namespace flagstone::cli

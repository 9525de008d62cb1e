// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/man_page.hpp"
#include "library/core/did_you_mean.hpp"

namespace flagstone::cli {
namespace {

class ManualCommand final : public Command {
 public:
  using Command::Command;
  std::string name;

  int run() override {
    const CLI::App& program = *parser().get_parent();
    fmt::print("{}", man_page(name.empty() ? program : *command_of(program)));
    return 0;
  }

 private:
  [[nodiscard]] const CLI::App* command_of(const CLI::App& program) const {
    std::vector<std::string_view> names;
    for (const CLI::App* const command : program.get_subcommands({})) {
      if (command->get_name() == name) return command;
      names.emplace_back(command->get_name());
    }
    throw std::invalid_argument("manual: " + no_such("command", name, names));
  }
};

}  // namespace

std::unique_ptr<Command> add_manual_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("manual", "Print the manual page of a command, as roff for man.");
  set_help(*command,
           {.examples = {{"flagstone manual segment | man -l -", "read it"},
                         {"flagstone manual > flagstone.1", "the page of the program"}},
            .notes = "The Debian package and 'make install' install all pages: 'man flagstone'.",
            .exit_codes = "0, success; 2, usage error."});
  auto made = std::make_unique<ManualCommand>(*command);
  command->add_option("command", made->name, "Command to describe")
      ->default_str("the program")
      ->type_name("NAME");
  return made;
}

}  // namespace flagstone::cli

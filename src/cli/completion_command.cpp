// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <string>
#include <utility>

#include "cli/commands.hpp"
#include "cli/completion_scripts.hpp"
#include "cli/help.hpp"
#include "cli/shared_options.hpp"

namespace flagstone::cli {
namespace {

using Script = std::string (*)(const CLI::App& program);

class CompletionCommand final : public Command {
 public:
  using Command::Command;
  Script script = nullptr;

  int run() override {
    fmt::print("{}", script(*parser().get_parent()));
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_completion_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "completion", "Print a script that completes commands and options in a shell.");
  set_help(*command,
           {.examples = {{"source <(flagstone completion bash)", "in ~/.bashrc"},
                         {"source <(flagstone completion zsh)", "in ~/.zshrc, after compinit"},
                         {"flagstone completion fish | source", "in ~/.config/fish/config.fish"}},
            .notes = "The Debian package and 'make install' install these scripts.",
            .exit_codes = "0, success; 2, usage error."});
  auto made = std::make_unique<CompletionCommand>(*command);
  add_choice_option<Script>(
      *command, "shell", "shell",
      {{"bash", bash_completions}, {"zsh", zsh_completions}, {"fish", fish_completions}},
      made->script,
      "Shell that runs the script"
      "\nbash\t4.4 or newer"
      "\nzsh\t5 or newer"
      "\nfish\t3 or newer")
      ->required()
      ->type_name("SHELL");
  return made;
}

}  // namespace flagstone::cli

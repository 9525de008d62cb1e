// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/config/config_toml.hpp"
#include "cli/commands.hpp"
#include "cli/derivation_text.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"

namespace flagstone::cli {
namespace {

/// Comment lines with the method and the preset or sensor.
std::string header_of(const config::MethodChoice& choice, const config::ResolvedMethod& method) {
  const std::optional<Sensor> sensor = config::chosen_sensor(choice);
  const bool has_presets = method.name == "patchwork" || method.name.starts_with("czm");
  std::string text = fmt::format("# flagstone, method {}", method.name);
  if (!sensor) {
    return text + (has_presets ? fmt::format(", from preset {}\n", choice.preset) : "\n");
  }
  text += fmt::format(", derived from sensor {}\n", sensor->name);
  return has_presets ? text + derivation_text(*sensor, *method.config.get_if<PatchworkConfig>())
                     : text;
}

class ConfigCommand final : public Command {
 public:
  using Command::Command;
  config::MethodChoice choice;

  int run() override {
    const config::ResolvedMethod method = config::resolve_one(choice);
    fmt::print("{}\n{}{}", header_of(choice, method), config::to_toml(method.config),
               config::to_toml(method.mount));
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_config_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("config", "Print all settings of a method as a TOML file for --config.");
  set_help(*command,
           {.examples = {{"flagstone config > mine.toml"},
                         {"flagstone config --method patchwork --sensor os0-128 > mine.toml"}},
            .exit_codes = "0, success; 1, error; 2, usage error."});
  auto made = std::make_unique<ConfigCommand>(*command);
  add_method_options(*command, made->choice);
  return made;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/config_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/config/config_toml.hpp"
#include "cli/method_options.hpp"
#include "cli/sensors_command.hpp"

namespace flagstone::cli {
namespace {

/// Where the settings come from, as comment lines.
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

}  // namespace

void add_config_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<config::MethodChoice>();
  CLI::App* command = app.add_subcommand(
      "config",
      "Print every setting, commented, as TOML that --config reads back.\n\n"
      "Example:  flagstone config --method patchwork --sensor os0-128 > mine.toml\n");
  add_method_options(*command, *choice);
  command->callback([choice, &exit_code] {
    const config::ResolvedMethod method = config::resolve_one(*choice);
    fmt::print("{}\n{}{}", header_of(*choice, method), config::to_toml(method.config),
               config::to_toml(method.mount));
    exit_code = 0;
  });
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/config_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/config/config_toml.hpp"
#include "cli/method_options.hpp"
#include "cli/sensors_command.hpp"

namespace flagstone::cli {
namespace {

/// Where the settings come from, as comment lines.
std::string header_of(const MethodOptions& options, const MethodConfig& config) {
  const std::optional<Sensor> sensor = options.chosen_sensor();
  std::string text = fmt::format("# flagstone, method {}", options.method);
  if (!sensor) {
    return text + (options.starts_from_preset() ? fmt::format(", from preset {}\n", options.preset)
                                                : "\n");
  }
  text += fmt::format(", derived from sensor {}\n", sensor->name);
  const auto* patchwork = std::get_if<PatchworkConfig>(&config);
  return patchwork != nullptr && options.starts_from_preset()
             ? text + derivation_text(*sensor, *patchwork)
             : text;
}

}  // namespace

void add_config_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MethodOptions>();
  CLI::App* command = app.add_subcommand(
      "config",
      "Print every setting, commented, as TOML that --config reads back.\n\n"
      "Example:  flagstone config --method patchwork --sensor os0-128 > mine.toml\n");
  options->add_to(*command);
  command->callback([options, &exit_code] {
    MountSettings mount;
    const MethodConfig config = options->resolve(mount);
    fmt::print("{}\n{}{}", header_of(*options, config), config::to_toml(config),
               config::to_toml(mount));
    exit_code = 0;
  });
}

}  // namespace flagstone::cli

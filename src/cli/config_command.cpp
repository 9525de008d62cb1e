// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/config_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/config_toml.hpp"
#include "cli/method_options.hpp"

namespace flagstone::cli {

void add_config_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MethodOptions>();
  CLI::App* command =
      app.add_subcommand("config",
                         "Print every setting, commented, as TOML that --config reads back.\n\n"
                         "Example:  flagstone config --preset paper > mine.toml\n");
  options->add_to(*command);
  command->callback([options, &exit_code] {
    MountSettings mount;
    const MethodConfig config = options->resolve(mount);
    const std::string origin =
        options->starts_from_preset() ? fmt::format(", from preset {}", options->preset) : "";
    fmt::print("# flagstone, method {}{}\n\n{}{}", options->method, origin, to_toml(config),
               to_toml(mount));
    exit_code = 0;
  });
}

}  // namespace flagstone::cli

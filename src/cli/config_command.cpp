// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/config_command.hpp"

#include <fmt/format.h>

#include <memory>

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
    const PatchworkConfig config = options->resolve();
    fmt::print("# flagstone, method {}, from preset {}\n\n{}", options->method, options->preset,
               to_toml(config));
    exit_code = 0;
  });
}

}  // namespace flagstone::cli

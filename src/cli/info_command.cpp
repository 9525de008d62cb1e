// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/scan_info.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/python_command.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/read_cloud.hpp"

namespace flagstone::cli {
namespace {

class InfoCommand final : public Command {
 public:
  using Command::Command;
  std::vector<std::string> scans;
  int columns = 0;

  int run() override {
    if (are_bags(scans)) run_in_python("info", nlohmann::ordered_json::object(), scans);
    int exit_code = 0;
    for (const std::string& scan : scans) {
      io::Cloud cloud;
      const Status status = io::read_cloud(scan, {.columns = columns}, cloud);
      if (status.ok()) {
        fmt::print("{}", app::info_text(scan, cloud));
      } else {
        print_error(status.message());
        exit_code = 1;
      }
    }
    return exit_code;
  }
};

}  // namespace

std::unique_ptr<Command> add_info_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("info", "Show the fields and bounds of scans, or the topics of bags.");
  set_help(*command, {.examples = {{"flagstone info scan.pcd"}, {"flagstone info street.mcap"}}});
  auto made = std::make_unique<InfoCommand>(*command);
  add_scans_option(*command, made->scans,
                   "Scan files (.bin, .pcd.bin, .pcd, .ply, .npy), or bags (.bag, .mcap, .db3, "
                   "directories with metadata.yaml)");
  add_columns_option(*command, made->columns);
  return made;
}

}  // namespace flagstone::cli

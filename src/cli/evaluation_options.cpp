// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/evaluation_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>

#include "cli/help.hpp"
#include "cli/shared_options.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {

void add_evaluation_options(CLI::App& command, app::EvaluationOptions& options) {
  command
      .add_option("datasets", options.datasets,
                  "Labelled scans: a SemanticKITTI tree (sequences/NN), a directory with velodyne/ "
                  "and labels/, or a directory of nuScenes-lidarseg files")
      ->required()
      ->type_name("DATASET");
  command
      .add_option("--protocol", options.protocol,
                  "Classes that count as ground: patchwork, patchwork++, lidarseg, simulation, or "
                  "a .toml or .json file")
      ->capture_default_str()
      ->type_name("NAME|FILE")
      ->group(input_group);
  command
      .add_option("--sequences", options.sequences,
                  "Sequences to use, separated by commas, e.g. 05,10")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("all")
      ->type_name("LIST")
      ->group(input_group);
  command.add_option("--every", options.every, "Use only every Nth scan of each sequence")
      ->check(in_range(std::size_t{1}, app::max_every))
      ->capture_default_str()
      ->type_name("N")
      ->group(input_group);
  add_columns_option(command, options.columns);
  add_threads_option(command, options.threads);
  command
      .add_flag("--resume", options.resume,
                "Resume an interrupted run; scans saved next to the results file are skipped")
      ->group(other_group);
  command.add_option("--json", options.files.json, "Write the results as JSON")
      ->type_name("FILE")
      ->group(output_group);
  command.add_option("--csv", options.files.csv, "Write the results as CSV")
      ->type_name("FILE")
      ->group(output_group);
  command
      .add_option("--html", options.files.html,
                  "Write a report with tables and plots, as one self-contained HTML file")
      ->type_name("FILE")
      ->group(output_group);
}

void write_result(const std::string& file, const std::function<std::string()>& text) {
  if (app::write_result(file, text)) fmt::print("wrote {}\n", io::printable(file));
}

}  // namespace flagstone::cli

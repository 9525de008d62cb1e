// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/evaluation_options.hpp"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/shared_options.hpp"
#include "files/io/message.hpp"

namespace flagstone::cli {

void add_evaluation_options(CLI::App& command, app::EvaluationOptions& options) {
  command
      .add_option("datasets", options.datasets,
                  "SemanticKITTI trees (sequences/NN), directories with velodyne/ and labels/, or "
                  "directories of nuScenes-lidarseg files")
      ->required()
      ->type_name("DATASET...");
  command
      .add_option("--protocol", options.protocol,
                  "Which classes are ground: patchwork, patchwork++, lidarseg, simulation, or a "
                  ".toml or .json file")
      ->capture_default_str()
      ->type_name("NAME|FILE");
  command
      .add_option("--sequences", options.sequences, "Sequences to use, e.g. 05,10. Default: all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LIST");
  command.add_option("--every", options.every, "Use one scan in N of each sequence")
      ->check(CLI::Range(std::size_t{1}, app::max_every))
      ->capture_default_str()
      ->type_name("N");
  add_columns_option(command, options.columns);
  add_threads_option(command, options.threads);
  command.add_flag("--resume", options.resume,
                   "Continue an interrupted run: scans in the checkpoint next to the results file "
                   "are not evaluated again");
  command.add_option("--json", options.files.json, "Write the results as JSON")->type_name("FILE");
  command.add_option("--csv", options.files.csv, "Write the results as CSV")->type_name("FILE");
  command
      .add_option("--html", options.files.html,
                  "Write a report with tables and plots: one self-contained file")
      ->type_name("FILE");
}

void write_result(const std::string& file, const std::function<std::string()>& text) {
  if (app::write_result(file, text)) fmt::print("wrote {}\n", io::printable(file));
}

}  // namespace flagstone::cli

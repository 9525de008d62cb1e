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

#include "app/evaluate.hpp"
#include "app/sweep.hpp"
#include "cli/commands.hpp"
#include "cli/evaluation_options.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/terminal.hpp"
#include "lab/report/sweep_report.hpp"

namespace flagstone::cli {
namespace {

struct SweepOptions {
  app::EvaluationOptions evaluation;
  config::MethodChoice method{.methods = {"r_gpf+u"}};
  std::vector<std::string> axes;
};

class SweepCommand final : public Command {
 public:
  using Command::Command;
  SweepOptions options;

  int run() override {
    const auto [name, base, mount] = config::resolve_one(options.method);
    app::Sweep sweep{.method = name, .axes = app::sweep_axes(options.axes)};
    app::EvaluationOptions how = options.evaluation;
    how.settings_files = {options.method.config_file, options.method.sensor};
    app::Evaluation evaluation(how, sweep.points(base, mount));
    catch_interrupts();
    ProgressBar bar;
    sweep.results = evaluation.run(bar.callbacks());
    bar.clear();
    if (sweep.results.scans == 0) return 1;

    fmt::print(
        "Method {}, protocol {}, {}. Percentages, averaged over scans; std: sample standard "
        "deviation;\n±95%: half-width of the 95 % confidence interval of the mean\n\n{}\n{}\n",
        sweep.method, sweep.results.protocol, app::scans_text(sweep.results), app::to_text(sweep),
        app::winner_text(sweep));
    if (evaluation.was_interrupted()) return 1;
    constexpr auto replace =
        nlohmann::json::error_handler_t::replace;  // file names may not be UTF-8
    write_result(how.files.json,
                 [&] { return app::to_json(sweep).dump(2, ' ', false, replace) + "\n"; });
    write_result(how.files.csv, [&] { return app::to_csv(sweep); });
    write_result(how.files.html, [&] { return report::sweep_report(app::to_json(sweep)); });
    evaluation.remove_checkpoint();
    return sweep.results.failures.empty() ? 0 : 1;
  }
};

}  // namespace

std::unique_ptr<Command> add_sweep_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("sweep", "Score a method over a grid of settings.");
  set_help(
      *command,
      {.examples = {{"flagstone sweep SemanticKITTI --every 100 --html sweep.html"},
                    {"flagstone sweep SemanticKITTI --method patchwork --param seed_count=10,20"}},
       .notes = "Without --param, the sweep reproduces Fig. 5 of the Patchwork paper: bin sizes of "
                "the uniform grid and uprightness angles."});
  auto made = std::make_unique<SweepCommand>(*command);
  SweepOptions* const options = &made->options;
  add_evaluation_options(*command, options->evaluation);
  add_method_options(*command, options->method);
  command
      ->add_option("--param", options->axes,
                   "A setting and its values; give it twice for a grid. The setting 'bins' takes "
                   "RINGSxSECTORS of a uniform polar grid")
      ->allow_extra_args(false)
      ->type_name("KEY=V,V,...")
      ->group(method_group);
  return made;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/eval_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/evaluate.hpp"
#include "app/worst_scans.hpp"
#include "cli/evaluation_options.hpp"
#include "cli/method_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "files/render/rendering_available.hpp"
#include "lab/eval/results_export.hpp"
#include "lab/eval/results_text.hpp"
#include "lab/report/eval_report.hpp"

namespace flagstone::cli {
namespace {

struct EvalOptions {
  app::EvaluationOptions evaluation;
  config::MethodChoice methods{.methods = {"surface", "patchwork"}};
  std::vector<std::string> labels{};
  io::LabelMap label_map = io::LabelMap::flagstone;
  std::size_t pictures = 0;
  std::string output = "flagstone-eval";
  bool speed = false;
};

void print_height_tables(const eval::Results& results, const eval::TextStyle& style) {
  fmt::print(
      "Heights above the ground against the truth, points of the ground, by horizontal range. "
      "Means over scans,\ncm: median of the absolute error, 95 %: its 95th percentile, bias: mean "
      "error. Coverage: percentage of points with a height\n\n{}\n",
      eval::height_table(results, &eval::HeightResult::ground, style));
  fmt::print("The same over all points, also where the ground is hidden\n\n{}\n",
             eval::height_table(results, &eval::HeightResult::everywhere, style));
}

void print_tables(const eval::Results& results, bool speed) {
  const eval::TextStyle style{.bold = isatty(STDOUT_FILENO) != 0};
  fmt::print(
      "Protocol {}, {}; percent. Means over scans, std: sample standard deviation, ±95%: half "
      "width of the\n95 % interval of the mean (Student's t, scans taken for independent). "
      "F1/cell: each 0.5 m BEV cell of each scan counts once. Hz: with {}.\n\n{}\n",
      results.protocol, app::scans_text(results),
      results.threads == 1 ? "one thread" : fmt::format("{} threads at work", results.threads),
      eval::accuracy_table(results, style));
  fmt::print("F1 by horizontal range, over all points of a band\n\n{}\n",
             eval::range_table(results, style));
  if (eval::has_heights(results)) print_height_tables(results, style);
  if (!results.unscored.empty()) {
    fmt::print("Left out, since no point of them is scored: {}\n\n",
               io::printable(fmt::format("{}", fmt::join(results.unscored, ", "))));
  }
  fmt::print("Lowest F1\n\n{}\n", eval::worst_table(results, 3));
  if (speed) {
    fmt::print(
        "Scans a second, one at a time on one core of {}; slowest 1%: of the scans; paper: on "
        "an i7-7700K,\nsequence 05 of SemanticKITTI\n\n{}\n",
        eval::machine_name(), eval::speed_table(results));
  }
  fmt::print("{}", eval::time_shares(results));
}

int evaluate(const EvalOptions& options) {
  if (const Status rendering_available = render::rendering_available();
      options.pictures > 0 && !rendering_available.ok()) {
    throw std::invalid_argument("--images: " + rendering_available.message());
  }
  app::EvaluationOptions how = options.evaluation;
  if (options.speed) how.threads = 1;
  how.settings_files = {options.methods.config_file, options.methods.sensor};
  app::Evaluation evaluation(
      how, app::methods_to_evaluate(options.methods, options.labels, options.label_map));
  if (options.pictures > 0) app::make_folder(options.output);
  catch_interrupts();
  ProgressBar bar;
  const app::RunCallbacks callbacks = bar.callbacks();
  const eval::Results results = evaluation.run(callbacks);
  bar.clear();
  if (results.scans == 0) return 1;

  print_tables(results, options.speed);
  if (evaluation.was_interrupted()) return 1;
  constexpr auto replace = nlohmann::json::error_handler_t::replace;  // file names may not be UTF-8
  write_result(how.files.json,
               [&] { return eval::to_json(results).dump(2, ' ', false, replace) + "\n"; });
  write_result(how.files.csv, [&] { return eval::to_csv(results); });
  const std::vector<report::ReportPicture> pictures =
      app::draw_worst_scans(evaluation, results, options.pictures, options.output, callbacks,
                            [](const auto& file) { fmt::print("drew {}\n", io::printable(file)); });
  write_result(how.files.html,
               [&] { return report::eval_report(eval::to_json(results), pictures); });
  evaluation.remove_checkpoint();
  if (interrupted()) {
    print_error(fmt::format("interrupted, {} of {} pictures are drawn", pictures.size(),
                            std::min(options.pictures, results.scans)));
    return 1;
  }
  return results.failures.empty() ? 0 : 1;
}

}  // namespace

void add_eval_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EvalOptions>();
  CLI::App* command = app.add_subcommand(
      "eval",
      "Score methods on labelled scans.\n\n"
      "Example:  flagstone eval SemanticKITTI --protocol patchwork --methods table1 --every 10\n");
  add_evaluation_options(*command, options->evaluation);
  add_methods_options(*command, options->methods);
  command
      ->add_option(
          "--labels", options->labels,
          "Labels that another program made, scored like a method: NAME.label, NAME.npy or "
          "NAME.label.npy of each scan, one code a point, 1 for ground; may repeat")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  const std::map<std::string, io::LabelMap> maps = {
      {"flagstone", io::LabelMap::flagstone}, {"semantic-kitti", io::LabelMap::semantic_kitti}};
  command
      ->add_option(
          "--label-map", options->label_map,
          "Codes in --labels: flagstone (1 is ground), or semantic-kitti (the classes that "
          "the protocol takes for ground)")
      ->transform(CLI::Transformer(maps).description(""))
      ->transform(CLI::IsMember(maps));
  command
      ->add_option("--images", options->pictures,
                   "Draw the N worst scans, methods side by side, into the directory of --output")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  command->add_option("-o,--output", options->output, "Directory for images (created if missing)")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--speed", options->speed,
                    "One thread, and a table of scans a second beside the paper's Table II");
  command->callback([options, &exit_code] { exit_code = evaluate(*options); });
}

}  // namespace flagstone::cli

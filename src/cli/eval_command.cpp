// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/evaluate.hpp"
#include "app/worst_scans.hpp"
#include "cli/commands.hpp"
#include "cli/evaluation_options.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/shared_options.hpp"
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
  std::vector<std::string> moving{};
  io::LabelMap label_map = io::LabelMap::flagstone;
  std::size_t pictures = 0;
  std::string output = "flagstone-eval";
  bool speed = false;
};

void print_height_tables(const eval::Results& results, const eval::TextStyle& style) {
  fmt::print(
      "Error of the height above the ground, in cm, at ground points, by horizontal range. Means "
      "over scans of\nthe median absolute error, its 95th percentile and the mean error (bias). "
      "Coverage: percentage of points with a height\n\n{}\n",
      eval::height_table(results, &eval::HeightResult::ground, style));
  fmt::print("Error of the height above the ground, at all points, including hidden ground\n\n{}\n",
             eval::height_table(results, &eval::HeightResult::everywhere, style));
  if (!eval::has_common_heights(results)) return;
  fmt::print("The same at ground points for which every method provides a height\n\n{}\n",
             eval::height_table(results, &eval::HeightResult::common_ground, style));
  fmt::print("The same at all points for which every method provides a height\n\n{}\n",
             eval::height_table(results, &eval::HeightResult::common_everywhere, style));
}

void print_moving_table(const eval::Results& results) {
  fmt::print(
      "Moving points of {} by horizontal range, up to {:g} m. IoU, recall and precision of moving "
      "points, in %,\nover the points of all scans. kept: static points, not ground, that are not "
      "marked. mean IoU and ±95%: over\nscans with moving points\n\n{}\n",
      app::scans_text(results), eval::range_bands.back(), eval::moving_table(results));
}

/// Tables of the methods.
void print_method_tables(const eval::Results& results, bool speed) {
  const eval::TextStyle style{.bold = isatty(STDOUT_FILENO) != 0};
  fmt::print(
      "Protocol {}, {}. Percentages, averaged over scans; std: sample standard deviation; ±95%: "
      "half-width of\nthe 95 % confidence interval of the mean (Student's t, assuming independent "
      "scans).\nF1/cell: each 0.5 m BEV cell of each scan counts once. Hz: with {}.\n\n{}\n",
      results.protocol, app::scans_text(results),
      results.threads == 1 ? "one thread" : fmt::format("{} threads", results.threads),
      eval::accuracy_table(results, style));
  fmt::print("F1 by horizontal range, over all points in each range\n\n{}\n",
             eval::range_table(results, style));
  if (eval::has_heights(results)) print_height_tables(results, style);
  if (!results.unscored.empty()) {
    fmt::print("Not counted, because no point is scored: {}\n\n",
               io::printable(fmt::format("{}", fmt::join(results.unscored, ", "))));
  }
  fmt::print("Lowest F1\n\n{}\n", eval::worst_table(results, 3));
  if (speed) {
    fmt::print(
        "Scans per second, one at a time on one core of {}. slowest 1%: the slowest 1 % of the "
        "scans;\npaper: on an i7-7700K, sequence 05 of SemanticKITTI\n\n{}\n",
        eval::machine_name(), eval::speed_table(results));
  }
}

void print_tables(const eval::Results& results, bool speed) {
  if (!results.methods.empty()) print_method_tables(results, speed);
  if (!results.moving.empty()) print_moving_table(results);
  fmt::print("{}", eval::time_shares(results));
}

class EvalCommand final : public Command {
 public:
  using Command::Command;
  EvalOptions options;

  int run() override {
    if (const Status rendering_available = render::rendering_available();
        options.pictures > 0 && !rendering_available.ok()) {
      throw std::invalid_argument("--images: " + rendering_available.message());
    }
    app::EvaluationOptions how = options.evaluation;
    if (options.speed) how.threads = 1;
    how.settings_files = {options.methods.config_file, options.methods.sensor};
    app::Evaluation evaluation(
        how, app::methods_to_evaluate(options.methods, options.labels, options.label_map),
        app::moving_to_evaluate(options.moving));
    if (options.pictures > 0) app::make_folder(options.output);
    catch_interrupts();
    ProgressBar bar;
    const app::RunCallbacks callbacks = bar.callbacks();
    const eval::Results results = evaluation.run(callbacks);
    bar.clear();
    if (results.scans == 0) return 1;

    print_tables(results, options.speed);
    if (evaluation.was_interrupted()) return 1;
    constexpr auto replace =
        nlohmann::json::error_handler_t::replace;  // file names may not be UTF-8
    write_result(how.files.json,
                 [&] { return eval::to_json(results).dump(2, ' ', false, replace) + "\n"; });
    write_result(how.files.csv, [&] { return eval::to_csv(results); });
    const std::vector<report::ReportPicture> pictures = app::draw_worst_scans(
        evaluation, results, options.pictures, options.output, callbacks,
        [](const auto& file) { fmt::print("wrote {}\n", io::printable(file)); });
    write_result(how.files.html,
                 [&] { return report::eval_report(eval::to_json(results), pictures); });
    evaluation.remove_checkpoint();
    if (interrupted()) {
      print_error(fmt::format("interrupted: {} of {} images are drawn", pictures.size(),
                              std::min(options.pictures, results.scans)));
      return 1;
    }
    return results.failures.empty() ? 0 : 1;
  }
};

}  // namespace

std::unique_ptr<Command> add_eval_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("eval", "Score methods, or files of other programs, on labelled scans.");
  set_help(*command,
           {.examples = {{"flagstone eval SemanticKITTI --every 10", "the default methods"},
                         {"flagstone eval SemanticKITTI --methods table1 --html report.html"},
                         {"flagstone eval nuscenes --protocol lidarseg --images 3"},
                         {"flagstone eval run --methods surface --labels map=DIR --moving map=DIR",
                          "a mapped run"}}});
  auto made = std::make_unique<EvalCommand>(*command);
  EvalOptions* const options = &made->options;
  add_evaluation_options(*command, options->evaluation);
  command
      ->add_option("--labels", options->labels,
                   "Labels of another program, scored like a method: a directory with NAME.label, "
                   "NAME.npy or NAME.label.npy for each scan, one code per point; or the output of "
                   "'flagstone map'")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false)
      ->group(input_group);
  command
      ->add_option("--moving", options->moving,
                   "Moving points to score: the output of 'flagstone map', or a directory with "
                   "NAME.npy (not 0: moves) or NAME.label (251 to 259: moves) for each scan; "
                   "--methods none scores nothing else")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false)
      ->group(input_group);
  add_choice_option(*command, "--label-map", "label map", label_maps(), options->label_map,
                    "Codes in --labels"
                    "\nflagstone\t1 is ground"
                    "\nsemantic-kitti\tthe ground classes of the protocol are ground")
      ->default_str("flagstone")
      ->group(input_group);
  add_methods_options(*command, options->methods);

  command->option_defaults()->group(output_group);
  command
      ->add_option("--images", options->pictures,
                   "Draw the N scans with the lowest F1, methods side by side, as PNG")
      ->check(in_range(0, 1000))
      ->type_name("N");
  command
      ->add_option("-o,--output", options->output,
                   "Directory for images, created if it does not exist")
      ->capture_default_str()
      ->type_name("DIR");
  command->add_flag("--speed", options->speed,
                    "Use one thread and print scans per second next to the paper's Table II");
  return made;
}

}  // namespace flagstone::cli

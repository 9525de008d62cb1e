// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sweep_command.hpp"

#include <fmt/format.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/evaluation.hpp"
#include "cli/method_options.hpp"
#include "cli/result_files.hpp"
#include "cli/sweep_results.hpp"
#include "lab/baselines/settings.hpp"
#include "lab/report/sweep_report.hpp"

namespace flagstone::cli {
namespace {

struct SweepOptions {
  EvaluationOptions evaluation;
  MethodOptions method;
  std::vector<std::string> axes;
  ResultFiles files;
};

/// Fig. 5 of the paper: bin sizes of the uniform grid and uprightness thresholds. The paper does
/// not print its values; at 0 degrees uprightness refuses nothing.
const std::vector<std::string> figure_5 = {"bins=10x36,15x54,20x72,30x108,45x162,60x216",
                                           "uprightness.angle=0,15,30,45,60,75"};

std::vector<SweepAxis> axes_of(const SweepOptions& options) {
  std::vector<SweepAxis> axes;
  for (const std::string& text : options.axes.empty() ? figure_5 : options.axes) {
    axes.push_back(sweep_axis(text));
  }
  if (axes.size() > 2) throw std::invalid_argument("--param can be given once or twice");
  if (axes.size() == 2 && axes[0].key == axes[1].key) {
    throw std::invalid_argument(
        fmt::format("--param names {} twice; give all its values at once", axes[0].key));
  }
  return axes;
}

/// A method per point of the grid.
std::vector<eval::Method> points_of(const Sweep& sweep, const MethodConfig& base,
                                    const MountSettings& mount) {
  std::size_t count = 1;
  for (const SweepAxis& axis : sweep.axes) count *= axis.values.size();
  constexpr std::size_t most = 10000;
  if (count > most) {
    throw std::invalid_argument(fmt::format("--param: {} points; allowed: up to {}", count, most));
  }
  std::vector<eval::Method> points;
  for (std::size_t p = 0; p < count; ++p) {
    const std::vector<std::string> values = sweep.values_at(p);
    MethodConfig config = base;
    for (std::size_t a = 0; a < values.size(); ++a) {
      if (sweep.axes[a].key != "bins") apply_axis(sweep.axes[a].key, values[a], config);
    }
    for (std::size_t a = 0; a < values.size(); ++a) {  // after what says where the rings begin
      if (sweep.axes[a].key == "bins") apply_axis(sweep.axes[a].key, values[a], config);
    }
    MountSettings own_mount = mount;  // whose height may be what is swept over
    own_mount.mount.sensor_height = sensor_height_of(config, mount.mount.sensor_height);
    points.push_back(eval::method_of(sweep.method, std::move(config), own_mount));
  }
  return points;
}

int sweep(const SweepOptions& options) {
  Sweep sweep{.method = options.method.method, .axes = axes_of(options), .results = {}};
  MountSettings mount;
  const MethodConfig base = options.method.resolve(mount);
  Evaluation evaluation(options.evaluation, points_of(sweep, base, mount),
                        options.files.checkpoint());
  options.files.prepare();
  sweep.results = evaluation.run();
  if (sweep.results.scans == 0) return 1;

  fmt::print(
      "Method {}, protocol {}, {}; percent. Means over scans, std: sample standard deviation, "
      "±95%: half width\nof the 95 % interval of the mean.\n\n{}\n{}\n",
      sweep.method, sweep.results.protocol, scans_text(sweep.results), to_text(sweep),
      winner_text(sweep));
  if (evaluation.was_interrupted()) return 1;
  constexpr auto replace = nlohmann::json::error_handler_t::replace;  // file names may not be UTF-8
  write_result(options.files.json,
               [&] { return to_json(sweep).dump(2, ' ', false, replace) + "\n"; });
  write_result(options.files.csv, [&] { return to_csv(sweep); });
  write_result(options.files.html, [&] { return report::sweep_report(to_json(sweep)); });
  evaluation.remove_checkpoint();
  return sweep.results.failures.empty() ? 0 : 1;
}

}  // namespace

void add_sweep_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  options->method.method = "r_gpf+u";
  CLI::App* command =
      app.add_subcommand("sweep",
                         "Score a method over a grid of settings.\n\n"
                         "Example:  flagstone sweep SemanticKITTI --every 100 --html sweep.html\n"
                         "          flagstone sweep SemanticKITTI --method patchwork --param "
                         "distance_margin=0.1,0.15\n\n"
                         "Without --param: the paper's Fig. 5, bin sizes of the uniform grid and "
                         "uprightness angles.\n");
  options->evaluation.add_to(*command);
  options->method.add_to(*command);
  command
      ->add_option("--param", options->axes,
                   "A setting and its values; given twice, a grid. The setting 'bins' takes "
                   "RINGSxSECTORS of a uniform polar grid")
      ->allow_extra_args(false)
      ->type_name("KEY=V,V,...");
  options->files.add_to(*command);
  command->callback([options, &exit_code] { exit_code = sweep(*options); });
}

}  // namespace flagstone::cli

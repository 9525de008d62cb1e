// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/scan_files.hpp"
#include "cli/commands.hpp"
#include "cli/help.hpp"
#include "cli/method_options.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/bench/benchmark.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/bench/results.hpp"
#include "library/core/did_you_mean.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone::cli {
namespace {

struct BenchOptions {
  std::vector<std::string> scans;
  int columns = 0;
  config::MethodChoice method;
  bench::BenchmarkSettings settings;
  bool peers = false;
  bench::ExternalToolPaths places;
  bool json = false;
};

/// The scans that can be read and contain a point. Errors of the other scans are printed.
std::vector<io::Cloud> read_scans(const std::vector<app::ScanInput>& inputs, int columns,
                                  std::vector<std::pair<std::string, std::string>>& errors) {
  std::vector<io::Cloud> clouds;
  for (const app::ScanInput& input : inputs) {
    io::Cloud cloud;
    const Status status = io::read_cloud(input.file, {.columns = columns}, cloud);
    if (status.ok() && !cloud.empty()) {
      clouds.push_back(std::move(cloud));
      continue;
    }
    const std::string error = status.ok() ? fmt::format("{}: has no points (expected at least one)",
                                                        io::printable(input.file))
                                          : std::string(status.message());
    print_error(error);
    errors.emplace_back(input.file.string(), error);
  }
  return clouds;
}

/// The settings of the method, which is surface or patchwork: --method accepts no other.
bench::TimedConfig timed_config(const MethodConfig& config) {
  if (const auto* const surface = config.get_if<SurfaceConfig>()) return *surface;
  return *config.get_if<PatchworkConfig>();
}

/// Prints the results, if there are any, and with --json the errors of scans.
void print_results(const bench::Results* results,
                   const std::vector<std::pair<std::string, std::string>>& errors, bool as_json) {
  if (!as_json) {
    if (results != nullptr) fmt::print("{}", bench::to_text(*results));
    return;
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (results != nullptr) json = bench::to_json(*results);
  for (const auto& [file, error] : errors) {
    json["errors"].push_back({{"file", file}, {"error", error}});
  }
  // File names may not be UTF-8.
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

class BenchCommand final : public Command {
 public:
  using Command::Command;
  BenchOptions options;

  int run() override {
    bench::BenchmarkSettings settings = options.settings;
    const config::ResolvedMethod method = config::resolve_one(options.method);
    settings.config = timed_config(method.config);
    settings.mount = method.mount;
    config::check_threads(method.mount, settings.threads);
    if (options.peers) settings.external_tools = options.places;
    ProgressBar bar;
    const std::vector<app::ScanInput> inputs = app::find_scans(options.scans, bar.callbacks());
    std::vector<std::pair<std::string, std::string>> errors;
    const std::vector<io::Cloud> clouds = read_scans(inputs, options.columns, errors);
    if (clouds.empty()) {
      print_results(nullptr, errors, options.json);
      return 1;
    }
    catch_interrupts();
    std::optional<app::ProgressMeter> meter;
    std::size_t all_rounds = 0;
    const bench::Results results =
        bench::run_benchmark(clouds, settings,
                             {.progress =
                                  [&](std::size_t round, std::size_t rounds) {
                                    if (!meter) meter.emplace(rounds * clouds.size());
                                    all_rounds = rounds;
                                    bar.show(meter->at(round * clouds.size()));
                                  },
                              .stop = interrupted});
    bar.clear();
    if (results.rounds == 0) {
      print_error("interrupted: nothing was measured, because no round was finished");
      return 1;
    }
    if (interrupted()) {
      print_error(
          fmt::format("interrupted: {} of {} rounds were started", results.rounds, all_rounds));
    }
    print_results(&results, errors, options.json);
    return interrupted() || !errors.empty() ? 1 : 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_bench_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "bench", "Time a method on scans and compare it with other implementations.");
  set_help(
      *command,
      {.examples = {{"flagstone bench scans/"},
                    {"flagstone bench scans/ --compare", "with PCL, Open3D and pypatchworkpp"}},
       .notes = "The scans are processed in rotation. The read-only baseline reads x, y and z "
                "of every point and writes one byte per point: a lower bound for any method. "
                "It runs over all scans twice in a row, and only the second pass is timed. "
                "Ratios are medians over pairs of times of the same scan and round."});
  auto made = std::make_unique<BenchCommand>(*command);
  BenchOptions* const options = &made->options;
  add_scans_option(*command, options->scans);
  add_columns_option(*command, options->columns);
  add_method_options(*command, options->method, bench::timed_methods);

  command->option_defaults()->group("Measurement");
  command->add_option("--rounds", options->settings.rounds, "Rounds over all scans, 1 to 1000000")
      ->check(in_range(1, 1000000))
      ->default_str("as many as fit in 10 s, at least 3")
      ->type_name("N");
  command
      ->add_option("--threads", options->settings.threads,
                   "Threads per scan, 1 to 1024; with 1, everything runs on one core")
      ->check(in_range(1, 1024))
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--isa", options->settings.target, "Instruction set")
      ->check(CLI::Validator(
          [](const std::string& name) {
            const auto known = simd_targets();
            const std::vector<std::string_view> names(known.begin(), known.end());
            const bool is_known = std::ranges::find(names, name) != names.end();
            return is_known ? std::string() : no_such("instruction set", name, names);
          },
          ""))
      ->default_str("the best one available")
      ->type_name("NAME");
  CLI::Option* const peers = command->add_flag(
      "--compare", options->peers,
      "Also time pypatchworkpp and the plane RANSAC of Open3D and PCL on the same points, as far "
      "as they are installed");
  command
      ->add_option("--python", options->places.python, "Python interpreter that has these packages")
      ->needs(peers)
      ->capture_default_str()
      ->type_name("COMMAND");
  command
      ->add_option("--compare-worker", options->places.worker, "Path of bench/external_worker.py")
      ->needs(peers)
      ->default_str("in the source tree of this command")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print one JSON object instead of tables")
      ->group(output_group);
  return made;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/scan_files.hpp"
#include "cli/commands.hpp"
#include "cli/method_options.hpp"
#include "cli/shared_options.hpp"
#include "cli/terminal.hpp"
#include "files/io/message.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/bench/benchmark.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/bench/results.hpp"
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

/// The scans that can be read and hold a point. What is wrong with others is printed.
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
    const std::string error =
        status.ok() ? fmt::format("{}: no point in it; a scan to time has one at least",
                                  io::printable(input.file))
                    : std::string(status.message());
    print_error(error);
    errors.emplace_back(input.file.string(), error);
  }
  return clouds;
}

/// The settings of the method that is timed. --method lets no other through.
bench::TimedConfig timed_config(const MethodConfig& config) {
  if (const auto* const surface = config.get_if<SurfaceConfig>()) return *surface;
  return *config.get_if<PatchworkConfig>();
}

/// Prints the results, if there are any, and in JSON the scans that could not be timed.
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
      print_error("interrupted before the first round, nothing is measured");
      return 1;
    }
    if (interrupted()) {
      print_error(
          fmt::format("interrupted, {} of {} rounds were begun", results.rounds, all_rounds));
    }
    print_results(&results, errors, options.json);
    return interrupted() || !errors.empty() ? 1 : 0;
  }
};

}  // namespace

std::unique_ptr<Command> add_bench_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "bench",
      "Time surface or Patchwork on scans, stage by stage, beside other programs.\n\n"
      "Example:  flagstone bench scans/ --compare\n\n"
      "Scans are taken in rotation. The read baseline reads x, y and z of every point and writes "
      "one\n"
      "byte a point. Ratios are medians of times of the same scan and round.\n");
  auto made = std::make_unique<BenchCommand>(*command);
  BenchOptions* const options = &made->options;
  add_scans_option(*command, options->scans);
  add_method_options(*command, options->method, bench::timed_methods);
  add_columns_option(*command, options->columns);
  command
      ->add_option("--rounds", options->settings.rounds,
                   "Rounds over all scans. Default: as many as take 10 s, 3 at least")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  command
      ->add_option("--threads", options->settings.threads,
                   "Threads that work on one scan; with one, all is timed on one core")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str()
      ->type_name("N");
  command->add_option("--isa", options->settings.target, "Instruction set. Default: the best")
      ->check(CLI::IsMember(simd_targets()))
      ->type_name("NAME");
  CLI::Option* const peers = command->add_flag(
      "--compare", options->peers,
      "Time pypatchworkpp, Open3D's and PCL's plane RANSAC on the same points too, as far as they "
      "are installed");
  command
      ->add_option("--python", options->places.python,
                   "Python that has the packages of the other implementations")
      ->needs(peers)
      ->capture_default_str()
      ->type_name("COMMAND");
  command
      ->add_option("--compare-worker", options->places.worker,
                   "bench/external_worker.py. Default: that of the source tree around the command")
      ->needs(peers)
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print one JSON object instead of tables");
  return made;
}

}  // namespace flagstone::cli

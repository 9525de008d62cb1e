// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/bench_command.hpp"

#include <fmt/format.h>

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

#include "cli/interrupt.hpp"
#include "cli/method_options.hpp"
#include "cli/print_error.hpp"
#include "cli/progress.hpp"
#include "cli/scan_inputs.hpp"
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
std::vector<io::Cloud> read_scans(const std::vector<ScanInput>& inputs, int columns) {
  std::vector<io::Cloud> clouds;
  for (const ScanInput& input : inputs) {
    io::Cloud cloud;
    const Status status = io::read_cloud(input.file, {.columns = columns}, cloud);
    if (!status.ok()) {
      print_error(status.message());
    } else if (cloud.empty()) {
      print_error(fmt::format("{}: no point in it; a scan to time has one at least",
                              io::printable(input.file)));
    } else {
      clouds.push_back(std::move(cloud));
    }
  }
  return clouds;
}

/// The settings of the method that is timed. --method lets no other through.
bench::TimedConfig timed_config(const MethodConfig& config) {
  if (const auto* const surface = config.get_if<SurfaceConfig>()) return *surface;
  return *config.get_if<PatchworkConfig>();
}

int bench(const BenchOptions& options) {
  bench::BenchmarkSettings settings = options.settings;
  const config::ResolvedMethod method = config::resolve_one(options.method);
  settings.config = timed_config(method.config);
  settings.mount = method.mount;
  config::check_threads(method.mount, settings.threads);
  if (options.peers) settings.external_tools = options.places;
  const std::vector<ScanInput> inputs = find_scans(options.scans);
  const std::vector<io::Cloud> clouds = read_scans(inputs, options.columns);
  if (clouds.empty()) return 1;

  catch_interrupts();
  std::optional<Progress> progress;
  std::size_t all_rounds = 0;
  const bench::Results results =
      bench::run_benchmark(clouds, settings,
                           {.progress =
                                [&](std::size_t round, std::size_t rounds) {
                                  if (!progress) progress.emplace(rounds * clouds.size());
                                  all_rounds = rounds;
                                  progress->show(round * clouds.size());
                                },
                            .stop = interrupted});
  progress.reset();

  if (results.rounds == 0) {
    print_error("interrupted before the first round, nothing is measured");
    return 1;
  }
  if (interrupted()) {
    print_error(fmt::format("interrupted, {} of {} rounds were begun", results.rounds, all_rounds));
  }
  fmt::print("{}", options.json ? bench::to_json(results).dump(2) + "\n" : bench::to_text(results));
  return interrupted() || clouds.size() < inputs.size() ? 1 : 0;
}

}  // namespace

void add_bench_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand(
      "bench",
      "Time surface or Patchwork on scans, stage by stage, beside other programs.\n\n"
      "Example:  flagstone bench scans/ --compare\n\n"
      "Scans are taken in rotation. The read baseline reads x, y and z of every point and writes "
      "one\n"
      "byte a point. Ratios are medians of times of the same scan and round.\n");
  command
      ->add_option("scans", options->scans,
                   "Scans, or folders of them (.bin, .pcd.bin, .pcd, .ply, .npy)")
      ->required()
      ->type_name("SCAN...");
  add_method_options(*command, options->method, bench::timed_methods);
  command
      ->add_option("--columns", options->columns,
                   "Floats a point in .bin files. Default: 5 for .pcd.bin, else 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
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
                   "bench/peer_worker.py. Default: that of the source tree around the command")
      ->needs(peers)
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print one JSON object instead of tables");
  command->callback([options, &exit_code] { exit_code = bench(*options); });
}

}  // namespace flagstone::cli

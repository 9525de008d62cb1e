// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/evaluation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "app/config/config_toml.hpp"
#include "cli/interrupt.hpp"
#include "cli/print_error.hpp"
#include "cli/progress.hpp"
#include "cli/thread_pool.hpp"
#include "files/io/message.hpp"
#include "flagstone/version.hpp"
#include "lab/eval/checkpoint.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/scan_evaluator.hpp"

namespace flagstone::cli {
namespace fs = std::filesystem;

namespace {

void throw_if_bad(const Status& status) {
  if (!status.ok()) throw std::invalid_argument(status.message());
}

/// The last folder of a path, "kitti" for "data/kitti/".
std::string dataset_name(const std::string& path) {
  const fs::path clean = fs::path(path).lexically_normal();
  const fs::path name = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
  return name.empty() || name == "." ? fs::absolute(clean).filename().string() : name.string();
}

std::vector<eval::LabelledScan> list_scans(const EvaluationOptions& options) {
  std::vector<eval::LabelledScan> scans;
  for (const std::string& dataset : options.datasets) {
    const std::size_t first = scans.size();
    throw_if_bad(eval::list_dataset(dataset, {options.sequences, options.every}, scans));
    if (options.datasets.size() == 1) break;
    for (std::size_t i = first; i < scans.size(); ++i) {
      scans[i].name = dataset_name(dataset) + "/" + scans[i].name;
    }
  }
  std::vector<std::string> names(scans.size());
  std::ranges::transform(scans, names.begin(), &eval::LabelledScan::name);
  std::ranges::sort(names);
  if (const auto twice = std::ranges::adjacent_find(names); twice != names.end()) {
    throw std::invalid_argument(fmt::format(
        "scan {} is listed twice; name every dataset and sequence once, and evaluate datasets of "
        "the same name apart",
        *twice));
  }
  return scans;
}

/// nuScenes' ids mean other things than SemanticKITTI's, and all would look wrong.
void check_ids(const eval::Protocol& protocol, const std::vector<eval::LabelledScan>& scans) {
  for (const eval::LabelledScan& scan : scans) {
    const bool are_lidarseg = scan.labels.extension() == ".bin";
    const bool wants_lidarseg = protocol.name == "lidarseg";
    const bool is_known = std::ranges::any_of(
        eval::known_protocols(), [&](const auto* known) { return known->name == protocol.name; });
    if (is_known && are_lidarseg != wants_lidarseg) {
      throw std::invalid_argument(
          fmt::format("{}: protocol {} is for {}; use --protocol {}", scan.labels.string(),
                      protocol.name, wants_lidarseg ? "nuScenes-lidarseg ids" : "SemanticKITTI ids",
                      are_lidarseg ? "lidarseg" : "patchwork or patchwork++"));
    }
  }
}

}  // namespace

void EvaluationOptions::add_to(CLI::App& command) {
  command
      .add_option("datasets", datasets,
                  "SemanticKITTI trees (sequences/NN), folders with velodyne/ and labels/, or "
                  "nuScenes-lidarseg files")
      ->required()
      ->type_name("DATASET...");
  command
      .add_option("--protocol", protocol,
                  "Which classes are ground: patchwork, patchwork++, lidarseg, simulation, or a "
                  ".toml or .json file")
      ->capture_default_str()
      ->type_name("NAME|FILE");
  command.add_option("--sequences", sequences, "Sequences to take, e.g. 05,10. Default: all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LIST");
  command.add_option("--every", every, "Take one scan in N of each sequence")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->type_name("N");
  command
      .add_option("--columns", columns,
                  "Floats a point in .bin files. Default: 5 for .pcd.bin, else 4")
      ->check(CLI::Range(3, 1024))
      ->type_name("N");
  command.add_option("--threads", threads, "Scans worked on at once. Default: all cores")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  command.add_flag("--resume", resume,
                   "Go on with an interrupted run: scans kept beside the results file are not done "
                   "again");
}

Evaluation::Evaluation(EvaluationOptions options, std::vector<eval::Method> methods,
                       fs::path checkpoint)
    : options_(std::move(options)),
      methods_(std::move(methods)),
      checkpoint_(std::move(checkpoint)) {
  throw_if_bad(eval::find_protocol(options_.protocol, protocol_));
  scans_ = list_scans(options_);
  check_ids(protocol_, scans_);
  for (const eval::Method& method : methods_) {
    if (method.config) check(*method.config);
  }
  if (options_.resume && checkpoint_.empty()) {
    throw std::invalid_argument(
        "--resume needs the results file that the interrupted run had: --json, --csv or --html");
  }
}

io::ReadOptions Evaluation::read_options() const noexcept { return {.columns = options_.columns}; }

std::string Evaluation::fingerprint() const {
  std::string text =
      fmt::format("{} {} ground {} ignored {}", FLAGSTONE_VERSION, protocol_.name,
                  fmt::join(protocol_.ground, " "), fmt::join(protocol_.ignored, " "));
  for (const auto& low : protocol_.low_ground) text += fmt::format(" {}<{}", low.id, low.height);
  for (const eval::Method& method : methods_) {
    text += fmt::format(
        "\n{} {}", method.name,
        method.config
            ? config::to_toml(*method.config) + config::to_toml(method.mount)
            : fmt::format("{} {}", method.labels.string(), static_cast<int>(method.label_map)));
  }
  text += fmt::format("\ncolumns {}", options_.columns);
  for (const std::string& dataset : options_.datasets) {  // scans of two may share their names
    std::error_code ignored;
    text += fmt::format("\n{}", fs::canonical(dataset, ignored).string());
  }
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

eval::Results Evaluation::run() {
  catch_interrupts();
  std::vector<std::optional<eval::ScanOutcome>> outcomes(scans_.size());
  eval::Checkpoint checkpoint;
  if (!checkpoint_.empty()) {
    std::map<std::string, eval::ScanOutcome> finished;
    throw_if_bad(options_.resume
                     ? checkpoint.resume(checkpoint_, fingerprint(), methods_.size(), finished)
                     : checkpoint.start(checkpoint_, fingerprint()));
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      const auto found = finished.find(scans_[i].name);
      if (found != finished.end()) outcomes[i] = std::move(found->second);
    }
  }
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    if (!outcomes[i]) left.push_back(i);
  }

  Progress progress(left.size());
  progress.show(0);
  std::mutex mutex;
  std::size_t done = 0;
  run_crew(left.size(), options_.threads, [&] {
    auto evaluator = std::make_shared<eval::ScanEvaluator>(methods_, protocol_, read_options());
    return [&, evaluator](std::size_t job) {
      const eval::LabelledScan& scan = scans_[left[job]];
      eval::ScanOutcome outcome = evaluator->run(scan);
      const std::scoped_lock lock(mutex);
      checkpoint.add(scan.name, outcome);
      const auto report = [&](const std::optional<std::string>& error) {
        if (!error) return;
        progress.clear();
        print_error(*error);
      };
      report(outcome.error);
      for (const eval::MethodOutcome& method : outcome.methods) report(method.error);
      outcomes[left[job]] = std::move(outcome);
      progress.show(++done);
    };
  });
  progress.clear();

  was_interrupted_ = done < left.size();
  if (was_interrupted_) {
    const std::size_t reached = scans_.size() - left.size() + done;
    print_error(fmt::format("interrupted, {} of {} scans are done; {}", reached, scans_.size(),
                            checkpoint_.empty()
                                ? "with --json FILE the next run could go on from here"
                                : "the same command with --resume goes on from here"));
  }
  eval::Results results = eval::gather(methods_, scans_, outcomes);
  if (results.scans == 0) remove_checkpoint();  // it holds nothing to go on from
  results.protocol = protocol_.name;
  results.threads = static_cast<unsigned>(std::min<std::size_t>(
      thread_count(options_.threads), std::max<std::size_t>(scans_.size(), 1)));
  for (const std::string& dataset : options_.datasets) {
    results.datasets.push_back(dataset_name(dataset));
  }
  return results;
}

void Evaluation::remove_checkpoint() const {
  std::error_code ignored;
  if (!checkpoint_.empty()) fs::remove(checkpoint_, ignored);
}

std::string scans_text(const eval::Results& results) {
  return fmt::format("{} {} of {}", results.scans, results.scans == 1 ? "scan" : "scans",
                     io::printable(fmt::format("{}", fmt::join(results.datasets, ", "))));
}

}  // namespace flagstone::cli

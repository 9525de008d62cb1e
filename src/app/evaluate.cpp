// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "app/config/config_toml.hpp"
#include "app/output_plan.hpp"
#include "files/io/atomic_file.hpp"
#include "files/io/message.hpp"
#include "flagstone/version.hpp"
#include "lab/eval/checkpoint.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/scan_evaluator.hpp"

namespace flagstone::app {
namespace fs = std::filesystem;

namespace {

/// A usage error is std::invalid_argument (exit code 2); a full disk is not (exit code 1).
void throw_if_bad(const Status& status) {
  if (status.ok()) return;
  if (status.code() == StatusCode::unwritable || status.code() == StatusCode::out_of_memory) {
    throw std::runtime_error(status.message());
  }
  throw std::invalid_argument(status.message());
}

void check_limits(const EvaluationOptions& options) {
  if (options.every < 1 || options.every > max_every) {
    throw std::invalid_argument(
        fmt::format("--every: {} is out of range (expected 1 to {})", options.every, max_every));
  }
}

/// The last directory of a path: "kitti" for "data/kitti/".
std::string dataset_name(const std::string& path) {
  const fs::path clean = fs::path(path).lexically_normal();
  const fs::path name = clean.has_filename() ? clean.filename() : clean.parent_path().filename();
  return name.empty() || name == "." ? fs::absolute(clean).filename().string() : name.string();
}

/// Finds out whether all scans are of one sequence, so that their names differ in the last part.
void mark_only_sequence(std::vector<eval::LabelledScan>& scans) {
  const auto sequence_of = [](const eval::LabelledScan& scan) {
    return fs::path(scan.name).parent_path();
  };
  const bool is_one = std::ranges::all_of(
      scans, [&](const auto& scan) { return sequence_of(scan) == sequence_of(scans.front()); });
  for (eval::LabelledScan& scan : scans) scan.is_of_only_sequence = is_one;
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
        "{}: this scan is listed twice (name each dataset and sequence once, and evaluate "
        "datasets of the same name separately)",
        *twice));
  }
  mark_only_sequence(scans);
  return scans;
}

/// nuScenes and SemanticKITTI use different class ids; mixing them up gives wrong scores.
void check_ids(const eval::Protocol& protocol, const std::vector<eval::LabelledScan>& scans) {
  for (const eval::LabelledScan& scan : scans) {
    const bool are_lidarseg = scan.labels.extension() == ".bin";
    const bool wants_lidarseg = protocol.name == "lidarseg";
    const bool is_known = std::ranges::any_of(
        eval::known_protocols(), [&](const auto* known) { return known->name == protocol.name; });
    if (is_known && are_lidarseg != wants_lidarseg) {
      throw std::invalid_argument(
          fmt::format("{}: protocol {} is for {} (expected --protocol {})", scan.labels.string(),
                      protocol.name, wants_lidarseg ? "nuScenes-lidarseg ids" : "SemanticKITTI ids",
                      are_lidarseg ? "lidarseg" : "patchwork or patchwork++"));
    }
  }
}

/// Moving points are classes of SemanticKITTI.
void check_moving_ids(const std::vector<eval::LabelledScan>& scans) {
  for (const eval::LabelledScan& scan : scans) {
    if (scan.labels.extension() != ".bin") continue;
    throw std::invalid_argument(fmt::format(
        "{}: moving points cannot be scored with nuScenes-lidarseg ids (expected a dataset with "
        "SemanticKITTI ids; remove --moving)",
        scan.labels.string()));
  }
}

/// A name and a directory.
struct NamedFolder {
  std::string name;
  fs::path folder;
};

/// Splits NAME=DIR, a value of `option`. The directory must exist.
NamedFolder named_folder(const char* option, const std::string& entry) {
  const std::size_t equals = entry.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == entry.size()) {
    throw std::invalid_argument(
        fmt::format("{0} {1}: is not NAME=DIR (expected e.g. {0} other=out/other)", option, entry));
  }
  NamedFolder named{.name = entry.substr(0, equals), .folder = entry.substr(equals + 1)};
  std::error_code error;
  if (!fs::is_directory(named.folder, error)) {
    throw std::invalid_argument(
        fmt::format("{} {}: {} is not a directory", option, entry, named.folder.string()));
  }
  return named;
}

eval::Method labels_made_elsewhere(const std::string& entry, io::LabelMap map) {
  NamedFolder named = named_folder("--labels", entry);
  eval::Method method;
  method.name = named.name;
  method.title = std::move(named.name);
  method.labels = std::move(named.folder);
  method.label_map = map;
  return method;
}

/// Throws for a name that is used twice; `what` describes the entries in the message.
template <class Entries>
void check_names(const Entries& entries, std::string_view what) {
  std::map<std::string, int> count;
  for (const auto& entry : entries) {
    if (++count[entry.name] == 2) {
      throw std::invalid_argument(fmt::format("{}: two {} have this name", entry.name, what));
    }
  }
}

}  // namespace

std::vector<eval::Method> methods_to_evaluate(const config::MethodChoice& choice,
                                              const std::vector<std::string>& labels,
                                              io::LabelMap label_map) {
  std::vector<eval::Method> methods;
  for (config::ResolvedMethod& method : config::resolve(choice)) {
    methods.push_back(eval::method_of(method.name, std::move(method.config), method.mount));
  }
  for (const std::string& entry : labels) {
    methods.push_back(labels_made_elsewhere(entry, label_map));
  }
  check_names(methods, "methods");
  return methods;
}

std::vector<eval::MovingSource> moving_to_evaluate(const std::vector<std::string>& entries) {
  std::vector<eval::MovingSource> sources;
  for (const std::string& entry : entries) {
    NamedFolder named = named_folder("--moving", entry);
    sources.push_back({.name = std::move(named.name), .folder = std::move(named.folder)});
  }
  check_names(sources, "directories of moving points");
  return sources;
}

fs::path ResultFiles::checkpoint() const {
  for (const std::string& file : {json, csv, html}) {
    if (!file.empty()) return file + ".checkpoint";
  }
  return {};
}

bool write_result(const std::string& file, const std::function<std::string()>& text) {
  if (file.empty()) return false;
  const Status status = io::write_file(file, std::string_view(text()));
  if (!status.ok()) throw std::runtime_error(std::string(status.message()));
  return true;
}

Evaluation::Evaluation(EvaluationOptions options, std::vector<eval::Method> methods,
                       std::vector<eval::MovingSource> moving)
    : options_(std::move(options)),
      methods_(std::move(methods)),
      moving_(std::move(moving)),
      checkpoint_(options_.files.checkpoint()) {
  check_limits(options_);
  if (methods_.empty() && moving_.empty()) {
    throw std::invalid_argument("no method to evaluate (set --methods, --labels or --moving)");
  }
  throw_if_bad(eval::find_protocol(options_.protocol, protocol_));
  scans_ = list_scans(options_);
  check_ids(protocol_, scans_);
  if (!moving_.empty()) check_moving_ids(scans_);
  for (const eval::Method& method : methods_) {
    if (method.config) method.config->check();
  }
  if (options_.resume && checkpoint_.empty()) {
    throw std::invalid_argument(
        "--resume: needs the results file of the interrupted run (set --json, --csv or --html)");
  }
  check_files();
}

void Evaluation::check_files() const {
  OutputPlan plan;
  for (const std::string& dataset : options_.datasets) plan.reads_dataset(dataset);
  for (const eval::Method& method : methods_) {
    if (!method.labels.empty()) plan.reads_dataset(method.labels);
  }
  for (const eval::MovingSource& source : moving_) plan.reads_dataset(source.folder);
  for (const std::string& file : options_.settings_files) plan.reads(file);
  if (fs::path(options_.protocol).has_extension()) plan.reads(options_.protocol);
  const ResultFiles& files = options_.files;
  for (const std::string& file : {files.json, files.csv, files.html}) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
      throw std::invalid_argument(
          fmt::format("{}: is a directory (expected a file)", io::printable(file)));
    }
    plan.writes(file);
  }
  plan.writes(checkpoint_);
  plan.check();
  for (const std::string& file : {files.json, files.csv, files.html}) {
    const fs::path folder = fs::path(file).lexically_normal().parent_path();
    if (!folder.empty()) make_folder(folder);
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
  for (const eval::MovingSource& source : moving_) {
    text += fmt::format("\nmoving {} {}", source.name, source.folder.string());
  }
  text += fmt::format("\ncolumns {}", options_.columns);
  for (const std::string& dataset :
       options_.datasets) {  // scans of two datasets may have the same names
    std::error_code ignored;
    text += fmt::format("\n{}", fs::canonical(dataset, ignored).string());
  }
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

eval::Results Evaluation::run(const RunCallbacks& callbacks) {
  std::vector<std::optional<eval::ScanOutcome>> outcomes(scans_.size());
  eval::Checkpoint checkpoint;
  if (!checkpoint_.empty()) {
    std::map<std::string, eval::ScanOutcome> finished;
    throw_if_bad(options_.resume
                     ? checkpoint.resume(checkpoint_, fingerprint(),
                                         {.methods = methods_.size(), .moving = moving_.size()},
                                         finished)
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

  const RunOutcome run = run_in_order(
      left.size(), options_.threads, "scans", callbacks,
      [&] {
        auto evaluator =
            std::make_unique<eval::ScanEvaluator>(methods_, protocol_, read_options(), moving_);
        return [&, evaluator = std::move(evaluator)](std::size_t job) {
          return evaluator->run(scans_[left[job]]);
        };
      },
      [&](std::size_t job, eval::ScanOutcome&& outcome) {
        checkpoint.add(scans_[left[job]].name, outcome);
        if (outcome.error) callbacks.say(*outcome.error);
        for (const eval::MethodOutcome& method : outcome.methods) {
          if (method.error) callbacks.say(*method.error);
        }
        for (const eval::MovingOutcome& moving : outcome.moving) {
          if (moving.error) callbacks.say(*moving.error);
        }
        outcomes[left[job]] = std::move(outcome);
      });

  was_interrupted_ = run.done < left.size();
  if (was_interrupted_) {
    callbacks.say(fmt::format("interrupted: {} of {} scans are done ({})",
                              scans_.size() - left.size() + run.done, scans_.size(),
                              checkpoint_.empty()
                                  ? "only runs with --json, --csv or --html can be resumed"
                                  : "run the same command with --resume for the rest"));
  }
  eval::Results results = eval::gather(methods_, scans_, outcomes, moving_);
  if (results.scans == 0) remove_checkpoint();  // there is nothing to resume
  results.protocol = protocol_.name;
  results.threads = static_cast<unsigned>(std::min<std::size_t>(
      threads_or_cores(options_.threads), std::max<std::size_t>(scans_.size(), 1)));
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

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: cannot be created: {}", io::printable(folder), error.message()));
  }
}

}  // namespace flagstone::app

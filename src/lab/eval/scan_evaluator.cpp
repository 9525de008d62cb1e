// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/scan_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "lab/eval/method_runner.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::eval {
namespace fs = std::filesystem;

namespace {

/// With more methods than this (in a sweep), methods are constructed again for every scan, because
/// keeping them all would take too much memory.
constexpr std::size_t most_kept = 32;

/// Path of the labels of scan "05/000120" in a tree with the layout of its dataset:
/// sequences/05/SUBDIRECTORY/000120.label. With several datasets, each has a directory with its
/// name.
fs::path in_tree(const fs::path& folder, const fs::path& name, const char* subdirectory,
                 const char* extension = ".label") {
  const fs::path file = fs::path(subdirectory) / (name.filename().string() + extension);
  const fs::path sequence = name.parent_path();
  if (sequence.empty()) return folder / file;
  return folder / sequence.parent_path() / "sequences" / sequence.filename() / file;
}

/// The file with a method's labels of a scan, or the first candidate if none exists.
fs::path label_file(const fs::path& folder, const std::string& name) {
  const std::array candidates = {folder / (name + ".label"),
                                 folder / (name + ".npy"),
                                 folder / (name + ".label.npy"),        // of --format u8
                                 in_tree(folder, name, "predictions"),  // SemanticKITTI's layout
                                 in_tree(folder, name, "velodyne"),     // 'flagstone segment TREE'
                                 in_tree(folder, name, "velodyne", ".label.npy")};
  std::error_code error;
  const auto* const found =
      std::ranges::find_if(candidates, [&](const auto& path) { return fs::exists(path, error); });
  return found == candidates.end() ? candidates.front() : *found;
}

}  // namespace

/// A method and its runner.
struct ScanEvaluator::Worker {
  const Method* method;
  std::unique_ptr<MethodRunner>
      runner;  // null for labels of another program, and between scans in a sweep
};

ScanEvaluator::ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                             const io::ReadOptions& read)
    : protocol_(protocol), read_options_(read) {
  for (const Method& method : methods) workers_.push_back({&method, nullptr});
}

ScanEvaluator::~ScanEvaluator() = default;

Status ScanEvaluator::read(const LabelledScan& scan) {
  if (Status status = io::read_cloud(scan.points, read_options_, cloud_); !status.ok()) {
    return status;
  }
  if (Status status = io::read_reference(scan.labels, cloud_.size(), classes_); !status.ok()) {
    return status;
  }
  ground_.clear();
  if (scan.ground.empty()) return {};
  return io::read_height_file(scan.ground, cloud_.size(), ground_);
}

Status ScanEvaluator::segment(Worker& worker, std::optional<double>& segment_ms) {
  const std::optional<MethodConfig>& config = worker.method->config;
  const bool is_new = !worker.runner && config;
  if (is_new) worker.runner = std::make_unique<MethodRunner>(*config, worker.method->mount);
  worker.runner->prepare(cloud_);
  // Warm up: allocate memory and fill caches before the first measured time.
  Status status;
  const bool is_kept = workers_.size() <= most_kept;
  if (is_new && is_kept) status = worker.runner->segment(cloud_, result_);
  // Reset the state, so that results do not depend on the order of scans and threads.
  worker.runner->reset();
  Stopwatch watch;
  if (status.ok()) status = worker.runner->segment(cloud_, result_);
  segment_ms = watch.lap();
  if (!is_kept) worker.runner.reset();
  return status;
}

Status ScanEvaluator::read_labels(const LabelledScan& scan, const Method& method) {
  std::vector<std::uint32_t> codes;
  const fs::path file = label_file(method.labels, scan.name);
  if (Status status = io::read_reference(file, cloud_.size(), codes); !status.ok()) return status;
  found_.resize(codes.size());
  if (method.label_map == io::LabelMap::flagstone) {
    std::ranges::transform(codes, found_.begin(), [](std::uint32_t code) {
      return code == static_cast<std::uint32_t>(Label::ground) ? Label::ground : Label::nonground;
    });
  } else {
    std::ranges::transform(
        truth_of(protocol_, cloud_.view(), codes), found_.begin(),
        [](Truth truth) { return truth == Truth::ground ? Label::ground : Label::nonground; });
  }
  return {};
}

Status ScanEvaluator::label(const LabelledScan& scan, Worker& worker,
                            std::optional<double>& segment_ms) {
  if (!worker.method->config) return read_labels(scan, *worker.method);
  return segment(worker, segment_ms);
}

std::span<const Label> ScanEvaluator::labels_of(const Worker& worker) const {
  return worker.method->config ? result_.labels() : std::span<const Label>(found_);
}

bool ScanEvaluator::has_heights_to_score(const Worker& worker) const {
  return worker.method->config && !ground_.empty() && !result_.heights().empty();
}

void ScanEvaluator::evaluate(const LabelledScan& scan, Worker& worker, ScanOutcome& outcome) {
  MethodOutcome& made = outcome.methods.emplace_back();
  Stopwatch watch;
  const Status status = label(scan, worker, made.segment_ms);
  if (!made.segment_ms) outcome.read_ms += watch.lap();
  if (!status.ok()) {
    made.error = fmt::format("{}: method {}: {}", io::printable(scan.points), worker.method->name,
                             status.message());
    return;
  }
  watch.lap();
  made.score = truth_.score(labels_of(worker));
  if (has_heights_to_score(worker)) {
    made.heights = score_heights(cloud_.view(), truth_.truth(), ground_, result_.heights());
  }
  outcome.score_ms += watch.lap();
}

ScanOutcome ScanEvaluator::run(const LabelledScan& scan) noexcept {
  ScanOutcome outcome;
  try {
    Stopwatch watch;
    if (const Status status = read(scan); !status.ok()) {
      outcome.error = status.message();
      return outcome;
    }
    outcome.read_ms = watch.lap();
    truth_.set(protocol_, cloud_.view(), classes_);
    outcome.score_ms = watch.lap();
    for (Worker& worker : workers_) evaluate(scan, worker, outcome);
  } catch (const std::bad_alloc&) {
    outcome.methods.clear();
    outcome.error = "not enough memory";  // short enough to be stored without allocation
  } catch (const std::exception& error) {
    outcome.methods.clear();
    outcome.error = error.what();
  }
  return outcome;
}

Status ScanEvaluator::label_all(const LabelledScan& scan, std::vector<std::vector<Label>>& labels) {
  labels.clear();
  if (Status status = read(scan); !status.ok()) return status;
  truth_.set(protocol_, cloud_.view(), classes_);
  for (Worker& worker : workers_) {
    std::optional<double> not_asked;
    std::vector<Label>& own = labels.emplace_back();
    if (!label(scan, worker, not_asked).ok()) continue;
    const std::span<const Label> found = labels_of(worker);
    own.assign(found.begin(), found.end());
  }
  return {};
}

}  // namespace flagstone::eval

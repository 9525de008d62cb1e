// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/scan_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "files/io/message.hpp"
#include "files/io/npy.hpp"
#include "lab/eval/found_files.hpp"
#include "lab/eval/method_runner.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::eval {
namespace {

/// With more methods than this (in a sweep), methods are constructed again for every scan, because
/// keeping them all would take too much memory.
constexpr std::size_t most_kept = 32;

}  // namespace

/// A method and its runner.
struct ScanEvaluator::Worker {
  const Method* method;
  std::unique_ptr<MethodRunner>
      runner;  // null for labels of another program, and between scans in a sweep
};

ScanEvaluator::ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                             const io::ReadOptions& read, std::span<const MovingSource> moving)
    : protocol_(protocol), read_options_(read), moving_(moving) {
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
  const LabelFile file = label_file(method.labels, scan);
  if (Status status = io::read_reference(file.path, cloud_.size(), codes_); !status.ok()) {
    return status;
  }
  found_heights_.clear();
  if (!file.heights.empty() && !ground_.empty()) {
    Status status = io::read_height_file(file.heights, cloud_.size(), found_heights_);
    if (!status.ok()) return status;
  }
  found_.resize(codes_.size());
  if (file.is_mapped || method.label_map == io::LabelMap::flagstone) {
    std::ranges::transform(codes_, found_.begin(), [](std::uint32_t code) {
      return code == static_cast<std::uint32_t>(Label::ground) ? Label::ground : Label::nonground;
    });
  } else {
    std::ranges::transform(
        truth_of(protocol_, cloud_.view(), codes_), found_.begin(),
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

std::span<const float> ScanEvaluator::heights_of(const Worker& worker) const {
  return worker.method->config ? result_.heights() : std::span<const float>(found_heights_);
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
  if (const std::span<const float> heights = heights_of(worker);
      !ground_.empty() && !heights.empty()) {
    made.heights = score_heights(cloud_.view(), truth_.truth(), ground_, heights);
    heights_.emplace_back(heights.begin(), heights.end());
  }
  outcome.score_ms += watch.lap();
}

/// Compares heights at the same points, if several methods provide heights and none failed.
void ScanEvaluator::evaluate_common_heights(ScanOutcome& outcome) {
  const auto failed = [](const MethodOutcome& made) { return made.error.has_value(); };
  if (heights_.size() < 2 || std::ranges::any_of(outcome.methods, failed)) return;
  Stopwatch watch;
  std::vector<HeightScore*> scores;
  for (MethodOutcome& made : outcome.methods) {
    if (made.heights) scores.push_back(&*made.heights);
  }
  score_common_heights(cloud_.view(), truth_.truth(), ground_, heights_, scores);
  outcome.score_ms += watch.lap();
}

void ScanEvaluator::evaluate_moving(const LabelledScan& scan, const MovingSource& source,
                                    ScanOutcome& outcome) {
  MovingOutcome& made = outcome.moving.emplace_back();
  Stopwatch watch;
  const Status status = read_moving(moving_file(source.folder, scan), cloud_.size(), codes_);
  outcome.read_ms += watch.lap();
  if (!status.ok()) {
    made.error = fmt::format("{}: moving points {}: {}", io::printable(scan.points), source.name,
                             status.message());
    return;
  }
  made.score = moving_truth_.score(codes_);
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
    if (!moving_.empty()) moving_truth_.set(cloud_.view(), classes_);
    outcome.score_ms = watch.lap();
    heights_.clear();
    for (Worker& worker : workers_) evaluate(scan, worker, outcome);
    evaluate_common_heights(outcome);
    for (const MovingSource& source : moving_) evaluate_moving(scan, source, outcome);
  } catch (const std::bad_alloc&) {
    outcome.methods.clear();
    outcome.moving.clear();
    outcome.error = "not enough memory";  // short enough to be stored without allocation
  } catch (const std::exception& error) {
    outcome.methods.clear();
    outcome.moving.clear();
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

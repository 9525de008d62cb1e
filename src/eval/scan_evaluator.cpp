// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/scan_evaluator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "io/message.hpp"

namespace flagstone::eval {
namespace fs = std::filesystem;

namespace {

class Clock {
 public:
  /// Milliseconds since it was made or asked last.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::milli> spent = now - last_;
    last_ = now;
    return spent.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// SemanticKITTI's place for the predictions of scan "05/000120".
fs::path prediction_of(const fs::path& folder, const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return folder / "predictions" / (name + ".label");
  return folder / "sequences" / name.substr(0, slash) / "predictions" /
         (name.substr(slash + 1) + ".label");
}

/// The file that holds a method's labels of a scan; the first that was looked for if there is none.
fs::path label_file(const fs::path& folder, const std::string& name) {
  const std::array candidates = {folder / (name + ".label"), folder / (name + ".npy"),
                                 prediction_of(folder, name)};
  std::error_code error;
  const auto* const found =
      std::ranges::find_if(candidates, [&](const auto& path) { return fs::exists(path, error); });
  return found == candidates.end() ? candidates.front() : *found;
}

bool is_ground_class(const Protocol& protocol, std::uint32_t id) {
  return std::ranges::find(protocol.ground, id) != protocol.ground.end();
}

/// The field `ring` of a cloud, one small whole number per point; empty where there is none.
void rings_of(const io::Cloud& cloud, std::vector<std::uint16_t>& rings) {
  rings.clear();
  const io::Field* field = cloud.find("ring");
  if (field == nullptr) return;
  rings.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    constexpr double most = std::numeric_limits<std::uint16_t>::max();
    const double ring = cloud.value(i, *field);
    rings[i] = static_cast<std::uint16_t>(ring >= 0 && ring <= most ? ring : most);
  }
}

}  // namespace

/// A method at work.
struct ScanEvaluator::Runner {
  const Method* method;
  std::unique_ptr<Segmenter> segmenter;  // null for labels made elsewhere
  Cascaded* ring_aware = nullptr;        // the segmenter, if it can be told the rings
  bool is_warm = false;
};

ScanEvaluator::ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                             const io::ReadOptions& read)
    : protocol_(protocol), read_options_(read) {
  for (const Method& method : methods) {
    Runner& runner = runners_.emplace_back();
    runner.method = &method;
    if (!method.config) continue;
    if (const auto* config = std::get_if<CascadedConfig>(&*method.config)) {
      auto cascaded = std::make_unique<Cascaded>(*config);
      runner.ring_aware = cascaded.get();
      runner.segmenter = std::move(cascaded);
    } else {
      runner.segmenter = make_segmenter(method.name, *method.config);
    }
  }
}

ScanEvaluator::~ScanEvaluator() = default;

Status ScanEvaluator::read(const LabelledScan& scan) {
  if (Status status = io::read_cloud(scan.points, read_options_, cloud_); !status.ok()) {
    return status;
  }
  return io::read_reference(scan.labels, cloud_.size(), classes_);
}

Status ScanEvaluator::segment(Runner& runner) {
  if (runner.ring_aware != nullptr && !rings_.empty()) {
    return runner.ring_aware->segment(cloud_.view(), rings_, result_);
  }
  return runner.segmenter->segment(cloud_.view(), result_);
}

Status ScanEvaluator::read_labels(const LabelledScan& scan, const Method& method) {
  std::vector<std::uint32_t> codes;
  const fs::path file = label_file(method.labels, scan.name);
  if (Status status = io::read_reference(file, cloud_.size(), codes); !status.ok()) return status;
  read_labels_.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const bool is_ground = method.label_map == io::LabelMap::flagstone
                               ? codes[i] == static_cast<std::uint32_t>(Label::ground)
                               : is_ground_class(protocol_, codes[i]);
    read_labels_[i] = is_ground ? Label::ground : Label::nonground;
  }
  return {};
}

MethodOutcome ScanEvaluator::evaluate(const LabelledScan& scan, Runner& runner, double& score_ms) {
  MethodOutcome outcome;
  Status status;
  if (runner.segmenter) {
    // Memory is taken and caches are filled before the first time that counts.
    if (!std::exchange(runner.is_warm, true)) status = segment(runner);
    Clock clock;
    if (status.ok()) status = segment(runner);
    outcome.segment_ms = clock.lap();
  } else {
    status = read_labels(scan, *runner.method);
  }
  if (!status.ok()) {
    const std::string reason = status.message().empty() ? "not enough memory" : status.message();
    outcome.error =
        fmt::format("{}: method {}: {}", io::printable(scan.points), runner.method->name, reason);
    return outcome;
  }
  Clock clock;
  outcome.score = truth_.score(runner.segmenter ? result_.labels() : read_labels_);
  score_ms += clock.lap();
  return outcome;
}

ScanOutcome ScanEvaluator::run(const LabelledScan& scan) noexcept {
  ScanOutcome outcome;
  try {
    Clock clock;
    if (const Status status = read(scan); !status.ok()) {
      outcome.error = status.message();
      return outcome;
    }
    rings_of(cloud_, rings_);
    outcome.read_ms = clock.lap();
    truth_.set(protocol_, cloud_.view(), classes_);
    outcome.score_ms = clock.lap();
    for (Runner& runner : runners_) {
      outcome.methods.push_back(evaluate(scan, runner, outcome.score_ms));
    }
  } catch (const std::bad_alloc&) {
    outcome.error = io::printable(scan.points) + ": not enough memory";
  } catch (const std::exception& error) {
    outcome.error = io::printable(scan.points) + ": " + error.what();
  }
  return outcome;
}

std::span<const Label> ScanEvaluator::labels(const LabelledScan& scan, std::size_t method) {
  Runner& runner = runners_[method];
  if (!read(scan).ok()) return {};
  rings_of(cloud_, rings_);
  truth_.set(protocol_, cloud_.view(), classes_);
  if (!runner.segmenter) {
    return read_labels(scan, *runner.method).ok() ? std::span<const Label>(read_labels_)
                                                  : std::span<const Label>();
  }
  return segment(runner).ok() ? result_.labels() : std::span<const Label>();
}

}  // namespace flagstone::eval

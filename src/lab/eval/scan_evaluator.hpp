// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/segmentation.hpp"
#include "lab/eval/dataset.hpp"
#include "lab/eval/method.hpp"
#include "lab/eval/moving.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::eval {
/// Outcome of one method on one scan.
struct MethodOutcome {
  std::optional<std::string> error;  ///< one line; the other members are then unset
  Score score;
  std::optional<HeightScore>
      heights;  ///< set if the method provides heights and the true heights are known
  std::optional<double> segment_ms;  ///< unset for labels of another program
};

/// Outcome of the moving points of one source on one scan.
struct MovingOutcome {
  std::optional<std::string> error;  ///< one line; the score is then unset
  MovingScore score;
};

/// Outcome of one scan.
struct ScanOutcome {
  std::optional<std::string>
      error;  ///< one line, if the scan or its ground truth could not be read
  std::vector<MethodOutcome> methods;
  std::vector<MovingOutcome> moving;
  double read_ms = 0;   ///< time to read points and classes
  double score_ms = 0;  ///< time to compute the ground truth and all scores
};

/// Runs methods on one scan after another and scores them, and moving points that are in files.
/// Reuses its memory. Not thread-safe: use one
/// instance per thread.
class ScanEvaluator {
 public:
  /// The arguments must outlive this object. Configurations are checked on first use.
  ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                const io::ReadOptions& read, std::span<const MovingSource> moving = {});
  ~ScanEvaluator();

  /// Evaluates a scan. Errors are reported in the outcome.
  ScanOutcome run(const LabelledScan& scan) noexcept;

  /// Computes the labels of every method for a scan, for images; empty for a method that failed.
  /// Afterwards `cloud()` and `truth()` return the data of this scan.
  Status label_all(const LabelledScan& scan, std::vector<std::vector<Label>>& labels);
  [[nodiscard]] CloudView cloud() const noexcept { return cloud_.view(); }
  [[nodiscard]] const ScanTruth& truth() const noexcept { return truth_; }

 private:
  struct Worker;
  Status read(const LabelledScan& scan);
  Status segment(Worker& worker, std::optional<double>& segment_ms);
  Status read_labels(const LabelledScan& scan, const Method& method);
  Status label(const LabelledScan& scan, Worker& worker, std::optional<double>& segment_ms);
  [[nodiscard]] std::span<const Label> labels_of(const Worker& worker) const;
  [[nodiscard]] std::span<const float> heights_of(const Worker& worker) const;
  void evaluate_common_heights(ScanOutcome& outcome);
  void evaluate(const LabelledScan& scan, Worker& worker, ScanOutcome& outcome);
  void evaluate_moving(const LabelledScan& scan, const MovingSource& source, ScanOutcome& outcome);

  const Protocol& protocol_;
  io::ReadOptions read_options_;
  std::vector<Worker> workers_;
  std::span<const MovingSource> moving_;
  io::Cloud cloud_;
  std::vector<std::uint32_t> classes_;
  std::vector<float> ground_;  // true ground height at each point; empty if unknown
  ScanTruth truth_;
  MovingTruth moving_truth_;
  Segmentation result_;
  std::vector<Label> found_;                 // labels read from the files of another program
  std::vector<float> found_heights_;         // heights of a mapped run; empty if it has none
  std::vector<std::vector<float>> heights_;  // heights of each method that provides them
  std::vector<std::uint32_t> codes_;         // numbers read from the files of another program
};

}  // namespace flagstone::eval

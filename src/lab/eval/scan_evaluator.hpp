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
#include "lab/eval/protocol.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::eval {
/// What one method made of one scan.
struct MethodOutcome {
  std::optional<std::string> error;  ///< one line; nothing else is filled then
  Score score;
  std::optional<HeightScore> heights;  ///< of methods that give heights where the truth is known
  std::optional<double> segment_ms;    ///< none for labels made elsewhere
};

/// What became of one scan.
struct ScanOutcome {
  std::optional<std::string> error;  ///< the scan or its truth could not be read: one line
  std::vector<MethodOutcome> methods;
  double read_ms = 0;   ///< points and classes
  double score_ms = 0;  ///< truth and all scores
};

/// Runs methods over one scan after another and scores them, reusing its memory. One per thread.
class ScanEvaluator {
 public:
  /// What is referred to must outlive it. Configurations are checked.
  ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                const io::ReadOptions& read);
  ~ScanEvaluator();

  /// Never throws: what goes wrong is in the outcome.
  ScanOutcome run(const LabelledScan& scan) noexcept;

  /// Every method's labels of a scan, for who draws them; none of a method that failed. cloud() and
  /// truth() are that scan's then.
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
  [[nodiscard]] bool has_heights_to_score(const Worker& worker) const;
  void evaluate(const LabelledScan& scan, Worker& worker, ScanOutcome& outcome);

  const Protocol& protocol_;
  io::ReadOptions read_options_;
  std::vector<Worker> workers_;
  io::Cloud cloud_;
  std::vector<std::uint32_t> classes_;
  std::vector<float> ground_;  // true height of the ground at each point; empty where unknown
  ScanTruth truth_;
  Segmentation result_;
  std::vector<Label> found_;  // by another program
};

}  // namespace flagstone::eval

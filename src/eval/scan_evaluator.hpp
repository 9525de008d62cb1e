// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "eval/dataset.hpp"
#include "eval/method.hpp"
#include "eval/outcome.hpp"
#include "eval/protocol.hpp"
#include "flagstone/segmentation.hpp"
#include "io/cloud.hpp"
#include "io/read_cloud.hpp"

namespace flagstone::eval {

/// Runs methods over one scan after another and scores them, reusing its memory. One per thread.
class ScanEvaluator {
 public:
  /// What is referred to must outlive it. Throws std::invalid_argument for a configuration out of
  /// range.
  ScanEvaluator(std::span<const Method> methods, const Protocol& protocol,
                const io::ReadOptions& read);
  ~ScanEvaluator();

  /// Never throws: what goes wrong is in the outcome.
  ScanOutcome run(const LabelledScan& scan) noexcept;

  /// The scan, its truth and a method's labels, for who draws them: valid until the next call.
  /// An empty span where something went wrong.
  std::span<const Label> labels(const LabelledScan& scan, std::size_t method);
  [[nodiscard]] CloudView cloud() const noexcept { return cloud_.view(); }
  [[nodiscard]] std::span<const Truth> truth() const noexcept { return truth_.truth(); }

 private:
  struct Runner;
  Status read(const LabelledScan& scan);
  Status segment(Runner& runner);
  Status read_labels(const LabelledScan& scan, const Method& method);
  MethodOutcome evaluate(const LabelledScan& scan, Runner& runner, double& score_ms);

  const Protocol& protocol_;
  io::ReadOptions read_options_;
  std::vector<Runner> runners_;
  io::Cloud cloud_;
  std::vector<std::uint32_t> classes_;
  std::vector<std::uint16_t> rings_;  // of the scan, where its file has them
  ScanTruth truth_;
  Segmentation result_;
  std::vector<Label> read_labels_;
};

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "files/io/read_cloud.hpp"
#include "lab/eval/dataset.hpp"
#include "lab/eval/method.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/results.hpp"

namespace flagstone::cli {

/// The options that say what is evaluated on and how, shared by the commands that score methods.
struct EvaluationOptions {
  std::vector<std::string> datasets;
  std::vector<std::string> sequences;
  std::size_t every = 1;
  std::string protocol = "patchwork";
  int columns = 0;
  unsigned threads = 0;
  bool resume = false;

  /// Adds the options to a command.
  void add_to(CLI::App& command);
};

/// Runs methods over the scans of datasets: in parallel, with a progress bar, able to stop and go
/// on.
class Evaluation {
 public:
  /// `checkpoint`: where finished scans are kept until the results are written; empty for nowhere.
  /// Throws std::invalid_argument with one line that says what is wrong with options, methods or
  /// datasets.
  Evaluation(EvaluationOptions options, std::vector<eval::Method> methods,
             std::filesystem::path checkpoint);

  /// Evaluates every scan that is not done. What goes wrong with a scan is printed and kept in the
  /// results. Results hold what was reached if somebody asked to stop.
  eval::Results run();

  /// Did somebody ask to stop before all was done? It has been said then.
  [[nodiscard]] bool was_interrupted() const noexcept { return was_interrupted_; }

  [[nodiscard]] const std::vector<eval::Method>& methods() const noexcept { return methods_; }
  [[nodiscard]] const std::vector<eval::LabelledScan>& scans() const noexcept { return scans_; }
  [[nodiscard]] const eval::Protocol& protocol() const noexcept { return protocol_; }
  [[nodiscard]] io::ReadOptions read_options() const noexcept;

  /// The results are written: what was kept to go on from may go.
  void remove_checkpoint() const;

 private:
  [[nodiscard]] std::string fingerprint() const;

  EvaluationOptions options_;
  std::vector<eval::Method> methods_;
  std::filesystem::path checkpoint_;
  eval::Protocol protocol_;
  std::vector<eval::LabelledScan> scans_;
  bool was_interrupted_ = false;
};

/// "4 scans of kitti, nuscenes" for headings.
std::string scans_text(const eval::Results& results);

}  // namespace flagstone::cli

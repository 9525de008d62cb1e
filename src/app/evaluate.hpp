// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/config/method_choice.hpp"
#include "app/run.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/dataset.hpp"
#include "lab/eval/method.hpp"
#include "lab/eval/moving.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/results.hpp"

namespace flagstone::app {

/// Result files to write; empty for none.
struct ResultFiles {
  std::string json{}, csv{}, html{};

  /// The checkpoint file, which stores finished scans during a run: next to the first result file;
  /// empty if there is none.
  [[nodiscard]] std::filesystem::path checkpoint() const;
};

/// Writes `text` to `file` and returns true; returns false if `file` is empty. Throws
/// std::runtime_error, one line, if the file cannot be written.
bool write_result(const std::string& file, const std::function<std::string()>& text);

/// Upper limit of EvaluationOptions::every.
inline constexpr std::size_t max_every = 1000000;

/// The chosen methods in their order, then one method per entry of `labels`: NAME=DIR, with labels
/// of another program in the codes of `label_map`. Throws std::invalid_argument with one line.
std::vector<eval::Method> methods_to_evaluate(const config::MethodChoice& choice,
                                              const std::vector<std::string>& labels,
                                              io::LabelMap label_map);

/// The sources of moving points in `entries`, each NAME=DIR. Throws std::invalid_argument with one
/// line.
std::vector<eval::MovingSource> moving_to_evaluate(const std::vector<std::string>& entries);

/// The scans to evaluate on, and how.
struct EvaluationOptions {
  std::vector<std::string> datasets;
  std::vector<std::string> sequences{};  ///< "05"; empty for all
  std::size_t every = 1;                 ///< 1 to max_every
  std::string protocol = "patchwork";    ///< name, or .toml or .json file
  int columns = 0;                       ///< floats per point in .bin files; 0: by the extension
  unsigned threads = 0;                  ///< scans processed in parallel; 0: all cores
  bool resume = false;                   ///< continue with the checkpoint of an interrupted run
  ResultFiles files{};
  std::vector<std::string> settings_files{};  ///< inputs that must not be overwritten
};

/// Runs methods on the scans of datasets, in parallel, and scores moving points. A run can be
/// stopped and resumed.
class Evaluation {
 public:
  /// Creates the directories of the result files. Throws std::invalid_argument, one line, if the
  /// options, methods or datasets are invalid or there is nothing to evaluate, and
  /// std::runtime_error if a directory cannot be created.
  Evaluation(EvaluationOptions options, std::vector<eval::Method> methods,
             std::vector<eval::MovingSource> moving = {});

  /// Evaluates every scan that is not in the checkpoint. Errors of scans are passed to
  /// `callbacks.message` and stored in the results. If stopped, the results cover the finished
  /// scans. Throws std::runtime_error if the checkpoint cannot be written.
  eval::Results run(const RunCallbacks& callbacks);

  /// True if `callbacks.stop` ended the run before all scans were done; a message reports it.
  [[nodiscard]] bool was_interrupted() const noexcept { return was_interrupted_; }

  [[nodiscard]] const std::vector<eval::Method>& methods() const noexcept { return methods_; }
  [[nodiscard]] const std::vector<eval::LabelledScan>& scans() const noexcept { return scans_; }
  [[nodiscard]] const eval::Protocol& protocol() const noexcept { return protocol_; }
  [[nodiscard]] io::ReadOptions read_options() const noexcept;

  /// Removes the checkpoint. Call it after the results are written.
  void remove_checkpoint() const;

 private:
  void check_files() const;
  [[nodiscard]] std::string fingerprint() const;

  EvaluationOptions options_;
  std::vector<eval::Method> methods_;
  std::vector<eval::MovingSource> moving_;
  std::filesystem::path checkpoint_;
  eval::Protocol protocol_;
  std::vector<eval::LabelledScan> scans_;
  bool was_interrupted_ = false;
};

/// "4 scans of kitti, nuscenes" for headings.
std::string scans_text(const eval::Results& results);

/// Creates a directory and its parents. Throws std::runtime_error with one line.
void make_folder(const std::filesystem::path& folder);

}  // namespace flagstone::app

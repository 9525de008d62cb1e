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
#include "lab/eval/protocol.hpp"
#include "lab/eval/results.hpp"

namespace flagstone::app {

/// Files that results are written to; empty for none.
struct ResultFiles {
  std::string json{}, csv{}, html{};

  /// The file that keeps finished scans while a run lasts: next to the first of the files; empty
  /// for none.
  [[nodiscard]] std::filesystem::path checkpoint() const;
};

/// Writes `text` to a result file, if it is named; says whether it was. Throws std::runtime_error
/// with one line.
bool write_result(const std::string& file, const std::function<std::string()>& text);

/// Takes one scan in 1 to this many of each sequence.
inline constexpr std::size_t max_every = 1000000;

/// The methods of a choice in their order, then those whose labels other programs made: `labels`
/// has NAME=DIR, `label_map` says what their codes mean. Throws std::invalid_argument with one
/// line.
std::vector<eval::Method> methods_to_evaluate(const config::MethodChoice& choice,
                                              const std::vector<std::string>& labels,
                                              io::LabelMap label_map);

/// On what methods are evaluated and how.
struct EvaluationOptions {
  std::vector<std::string> datasets;
  std::vector<std::string> sequences{};  ///< "05"; empty for all
  std::size_t every = 1;                 ///< 1 to max_every
  std::string protocol = "patchwork";    ///< name, or .toml or .json file
  int columns = 0;                       ///< floats per point in .bin files; 0: by the extension
  unsigned threads = 0;                  ///< scans processed in parallel; 0: all cores
  bool resume = false;                   ///< continue with the checkpoint of an interrupted run
  ResultFiles files{};
  std::vector<std::string> settings_files{};  ///< that methods were made from: never overwritten
};

/// Runs methods over the scans of datasets: in parallel, and so that it can be stopped and resumed.
class Evaluation {
 public:
  /// Creates the directories of the result files. Throws std::invalid_argument with one line that
  /// says what is wrong with options, methods or datasets, std::runtime_error if a directory cannot
  /// be created.
  Evaluation(EvaluationOptions options, std::vector<eval::Method> methods);

  /// Evaluates every scan that the checkpoint does not have. Errors of scans go to
  /// `callbacks.message` and into the results. If stopped, results are of the scans done so far.
  /// Throws std::runtime_error if the checkpoint cannot be written.
  eval::Results run(const RunCallbacks& callbacks);

  /// Did `callbacks.stop` end the run before all scans were done? The message says so then.
  [[nodiscard]] bool was_interrupted() const noexcept { return was_interrupted_; }

  [[nodiscard]] const std::vector<eval::Method>& methods() const noexcept { return methods_; }
  [[nodiscard]] const std::vector<eval::LabelledScan>& scans() const noexcept { return scans_; }
  [[nodiscard]] const eval::Protocol& protocol() const noexcept { return protocol_; }
  [[nodiscard]] io::ReadOptions read_options() const noexcept;

  /// Removes the checkpoint: the results are written.
  void remove_checkpoint() const;

 private:
  void check_files() const;
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

/// Creates a directory and its parents. Throws std::runtime_error with one line.
void make_folder(const std::filesystem::path& folder);

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "flagstone/status.hpp"
#include "lab/eval/scan_evaluator.hpp"

namespace flagstone::eval {

/// Number of methods and of sources of moving points in an evaluation.
struct OutcomeCounts {
  std::size_t methods = 0;
  std::size_t moving = 0;
};

/// A checkpoint file with the finished scans of an evaluation, so that an interrupted run can be
/// resumed. The first line of JSON identifies the evaluation; then there is one line per scan.
/// Lines truncated by a crash are skipped. Not thread-safe.
class Checkpoint {
 public:
  /// Starts a checkpoint. `evaluation` is one line that identifies evaluations whose outcomes can
  /// be combined. Errors: invalid_argument if `path` is a checkpoint with scans, which is not
  /// overwritten; unwritable.
  Status start(const std::filesystem::path& path, const std::string& evaluation);

  /// Resumes a checkpoint and adds its outcomes to `finished`, by scan. Scans with other
  /// numbers of outcomes than `counts` are skipped. Starts a checkpoint if the file does not exist.
  /// Errors: invalid_argument for a checkpoint of another evaluation, bad_file for any other file,
  /// unwritable.
  Status resume(const std::filesystem::path& path, const std::string& evaluation,
                const OutcomeCounts& counts, std::map<std::string, ScanOutcome>& finished);

  /// Adds a scan if it has no error of a method or of moving points, so that failed scans are tried
  /// again. Write errors are ignored: the scan is then evaluated again.
  void add(const std::string& scan, const ScanOutcome& outcome);

 private:
  Status open(const std::filesystem::path& path);

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace flagstone::eval

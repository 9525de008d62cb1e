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

/// Finished scans of an evaluation on disk, so that an interrupted one can go on: a line of JSON
/// that says which evaluation it is, then one per scan. A line cut short by a crash is passed over.
class Checkpoint {
 public:
  /// Begins a checkpoint. `evaluation` is one line that two evaluations share only if their
  /// outcomes can be mixed. An older checkpoint that holds scans is what an interrupted run left
  /// and is not written over: invalid_argument. unwritable.
  Status start(const std::filesystem::path& path, const std::string& evaluation);

  /// Goes on with a checkpoint: gives what it holds, by scan; outcomes of other than `methods`
  /// methods are none of this evaluation's. Begins one where there is none. invalid_argument for
  /// one of another evaluation, bad_file for what is no checkpoint, unwritable.
  Status resume(const std::filesystem::path& path, const std::string& evaluation,
                std::size_t methods, std::map<std::string, ScanOutcome>& finished);

  /// Adds a scan on which nothing failed, so that the others are tried again. Lost if the disk is
  /// full, which costs no more than doing it again.
  void add(const std::string& scan, const ScanOutcome& outcome);

 private:
  Status open(const std::filesystem::path& path);

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "app/doctor/examination.hpp"
#include "app/output_plan.hpp"
#include "app/run.hpp"
#include "files/io/cloud.hpp"
#include "flagstone/make_segmenter.hpp"

namespace flagstone::app {

/// The scans to examine, and the settings to compare them with.
struct DoctorRequest {
  std::vector<std::string> scans;  ///< files and directories
  std::size_t max_scans = 5;       ///< per directory, evenly spaced
  std::string method;
  MethodConfig config;
  int columns = 0;
  std::string output{};  ///< file for the recommended settings; empty for none
  OutputPlan plan{};     ///< with the files that settings come from
};

/// Findings and recommended settings.
struct DoctorReport {
  /// A scan that cannot be read.
  struct Failure {
    std::string file;
    std::string error;  ///< one line
  };

  std::vector<std::string> files{};  ///< the scans that were read
  std::vector<Failure> failures{};
  std::string method{};  ///< the scans are compared with its settings
  doctor::Diagnosis diagnosis{};
  bool interrupted = false;

  /// True if all scans were examined and no finding has severity `fix`.
  [[nodiscard]] bool ok() const;
};

/// Examines scans one by one and combines the results. Not thread-safe.
class ScanExaminer {
 public:
  /// Scans are compared with the settings of `config`.
  ScanExaminer(std::string method, const MethodConfig& config);

  /// Examines a scan. `name` is its path, or another description of its origin.
  void examine(const std::string& name, const io::Cloud& cloud);

  /// Records a scan that cannot be read, with a message of one line.
  void fail(const std::string& name, const std::string& error);

  /// The diagnosis of all scans so far; empty if no scan was examined.
  [[nodiscard]] DoctorReport report() const;

 private:
  doctor::Expected expected_;
  std::vector<doctor::Examination> examinations_;
  DoctorReport report_;
};

/// Examines scans and writes the recommended settings. If no scan can be read, or if interrupted,
/// there is no diagnosis. Throws std::invalid_argument if the output would overwrite an input,
/// std::runtime_error if it cannot be written.
DoctorReport examine_files(const DoctorRequest& request, const RunCallbacks& callbacks);

/// One block per finding: first severity `fix`, then `note`, then `fine`. The last line counts the
/// findings. `bold`: emphasise `fix` and `note` with terminal escape codes.
std::string text_of(const DoctorReport& report, bool bold);

/// One JSON object, see docs/reference/doctor-json.md.
std::string json_of(const DoctorReport& report);

/// The recommended settings as TOML; a comment if there are none.
std::string toml_of(const DoctorReport& report);

}  // namespace flagstone::app

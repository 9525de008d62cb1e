// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "app/output_plan.hpp"
#include "app/run.hpp"
#include "flagstone/make_segmenter.hpp"

namespace flagstone::app {

/// Which scans to examine, and the settings to compare them with.
struct DoctorRequest {
  std::vector<std::string> scans;  ///< files, and folders of them
  std::size_t max_scans = 5;       ///< of each folder, spread over it evenly
  std::string method;
  MethodConfig config;
  int columns = 0;
  std::string output{};  ///< file for the settings that fit; empty for none
  OutputPlan plan{};     ///< the files that settings came from
};

/// What the doctor saw and says.
struct DoctorReport {
  /// A scan that cannot be read.
  struct Failure {
    std::string file;
    std::string error;  ///< one line
  };

  std::vector<std::string> files{};  ///< those that were read
  std::vector<Failure> failures{};
  std::string method{};  ///< whose settings the scans were compared with
  doctor::Diagnosis diagnosis{};
  bool interrupted = false;

  /// Is every scan examined, with nothing to fix?
  [[nodiscard]] bool ok() const;
};

/// Examines scans and writes the settings that fit. Without a readable scan, and if interrupted,
/// there is no diagnosis. Throws std::invalid_argument if the output would overwrite an input,
/// std::runtime_error if it cannot be written.
DoctorReport examine_files(const DoctorRequest& request, const RunCallbacks& callbacks);

/// A block a finding, what is to fix first, then notes, then what is fine; ends with how many there
/// are of each. `bold`: with the codes of a terminal for what matters.
std::string text_of(const DoctorReport& report, bool bold);

/// One object; docs/reference/doctor-json.md lists its keys.
std::string json_of(const DoctorReport& report);

/// The settings that fit, for a configuration file. Where there are none, a comment that says so.
std::string toml_of(const DoctorReport& report);

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"

namespace flagstone::cli {

/// What the doctor saw and says.
struct DoctorReport {
  std::vector<std::string> files;  ///< those that were read
  std::string method;              ///< whose settings the scans were compared with
  doctor::Diagnosis diagnosis;
};

/// A block a finding, what is to fix first, then notes, then what is fine; ends with how many there
/// are of each. `bold`: with the codes of a terminal for what matters.
std::string text_of(const DoctorReport& report, bool bold);

/// One object; docs/doctor.md says what its keys mean.
std::string json_of(const DoctorReport& report);

/// The settings that fit, for a configuration file. Where there are none, a comment that says so.
std::string toml_of(const DoctorReport& report);

}  // namespace flagstone::cli

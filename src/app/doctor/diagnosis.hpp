// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/doctor/summary.hpp"
#include "flagstone/mount.hpp"

namespace flagstone::doctor {

/// Importance of a finding.
enum class Severity {
  fine,  ///< no problem
  note,  ///< for information; no action is needed
  fix,   ///< harms the labels until it is fixed
};

/// "fine", "note" or "fix".
const char* to_string(Severity severity) noexcept;

/// Result of one check.
struct Finding {
  std::string id;  ///< stable, for scripts: "tilt"
  Severity severity = Severity::fine;
  std::string sentence{};                                ///< the observation, with its numbers
  std::string remedy{};                                  ///< recommended action; empty if none
  std::vector<std::pair<std::string, double>> values{};  ///< the numbers, by name
  bool is_plain = false;  ///< fine; the text report lists only the id
};

/// The settings that scans are compared with.
struct Expected {
  float sensor_height = 1.73f;       ///< metres
  std::optional<float> max_range{};  ///< metres; empty for methods without this setting
};

/// Recommended settings.
struct Advice {
  std::string sensor{};    ///< name of the most likely known sensor; empty if none matches
  Mount mount{};           ///< includes the sensor height
  bool has_mount = false;  ///< true if more than the height differs from the default
};

/// All findings, and the recommended settings.
struct Diagnosis {
  std::vector<Finding> findings;
  /// Empty if no settings help.
  std::optional<Advice> advice{};

  [[nodiscard]] bool has_something_to_fix() const;
};

/// Compares the summary of scans with the configured settings.
Diagnosis diagnose(const Summary& summary, const Expected& expected);

}  // namespace flagstone::doctor

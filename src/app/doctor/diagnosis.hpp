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

/// How much a finding matters.
enum class Severity {
  fine,  ///< as it should be
  note,  ///< worth to know; nothing has to be done
  fix,   ///< labels suffer until it is set right
};

/// "fine", "note" or "fix".
const char* to_string(Severity severity) noexcept;

/// One thing that scans show.
struct Finding {
  std::string id;  ///< stable, for scripts: "tilt"
  Severity severity = Severity::fine;
  std::string sentence{};  ///< what is seen, with its numbers
  std::string remedy{};    ///< what to set or do; empty where there is nothing
  std::vector<std::pair<std::string, double>> values{};  ///< the numbers by name
  bool is_plain = false;  ///< fine, and nobody needs to read more about it
};

/// The settings that scans are compared with.
struct Expected {
  float sensor_height = 1.73f;       ///< metres
  std::optional<float> max_range{};  ///< metres, of methods that have such a setting
};

/// Settings that fit the scans.
struct Advice {
  std::string sensor{};    ///< name of the known sensor that made them; empty if none matches
  Mount mount{};           ///< with the sensor's height
  bool has_mount = false;  ///< Is more of it needed than the height?
};

/// What is to be said of scans.
struct Diagnosis {
  std::vector<Finding> findings;
  /// Empty where no settings help.
  std::optional<Advice> advice{};

  [[nodiscard]] bool has_something_to_fix() const;
};

/// What the scans show beside what is expected of them.
Diagnosis diagnose(const Summary& summary, const Expected& expected);

}  // namespace flagstone::doctor

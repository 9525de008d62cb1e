// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/diagnosis.hpp"

#include <algorithm>

#include "app/doctor/advice.hpp"
#include "app/doctor/frame_findings.hpp"
#include "app/doctor/matching_sensors.hpp"
#include "app/doctor/point_findings.hpp"
#include "app/doctor/sensor_findings.hpp"

namespace flagstone::doctor {

const char* to_string(Severity severity) noexcept {
  switch (severity) {
    case Severity::fine: return "fine";
    case Severity::note: return "note";
    case Severity::fix: return "fix";
  }
  return "unknown";
}

bool Diagnosis::has_something_to_fix() const {
  return std::ranges::any_of(findings,
                             [](const Finding& f) { return f.severity == Severity::fix; });
}

Diagnosis diagnose(const Summary& summary, const Expected& expected) {
  Diagnosis diagnosis;
  add_point_findings(summary, diagnosis.findings);
  if (!summary.is_scan()) return diagnosis;
  const std::vector<const Sensor*> sensors = matching_sensors(summary);
  if (summary.orientation)
    diagnosis.advice = advise(summary, *summary.orientation, expected, sensors);
  add_frame_findings(summary, expected, diagnosis.advice, diagnosis.findings);
  add_sensor_findings(summary, expected, sensors, diagnosis.findings);
  return diagnosis;
}

}  // namespace flagstone::doctor

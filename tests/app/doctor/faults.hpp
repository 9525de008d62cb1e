// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "flagstone/cloud_view.hpp"

namespace flagstone::doctor {

/// A fault of a scan, and the finding that the doctor must report.
struct Fault {
  std::string name;
  std::string finding;  ///< id of the finding
  Severity severity;
  std::function<std::vector<Point>(const std::vector<Point>&)> apply;
  Expected expected{};                 ///< the settings that the scan is compared with
  std::set<std::string> comes_with{};  ///< other findings that this fault also causes
};

/// Prints the name of the fault if a test fails.
inline void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

/// All faults that the doctor can find.
const std::vector<Fault>& faults();

}  // namespace flagstone::doctor

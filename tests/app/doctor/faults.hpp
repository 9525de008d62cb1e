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

/// Something that can be wrong with a scan, and what the doctor has to find then.
struct Fault {
  std::string name;
  std::string finding;  ///< its id
  Severity severity;
  std::function<std::vector<Point>(const std::vector<Point>&)> apply;
  Expected expected{};                 ///< the settings the scan is compared with
  std::set<std::string> comes_with{};  ///< other findings that cannot be told from it
};

/// Its name, where a test fails.
inline void PrintTo(const Fault& fault, std::ostream* out) { *out << fault.name; }

/// Every fault that there is a finding for.
const std::vector<Fault>& faults();

}  // namespace flagstone::doctor

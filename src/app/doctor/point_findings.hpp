// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/doctor/diagnosis.hpp"

namespace flagstone::doctor {

/// Adds what the points themselves say: points, zero_returns, not_finite, duplicate_points and, if
/// there are enough of them, coordinates and single_viewpoint.
void add_point_findings(const Summary& summary, std::vector<Finding>& findings);

}  // namespace flagstone::doctor

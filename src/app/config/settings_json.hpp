// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/config/method_choice.hpp"

namespace flagstone::config {

/// All settings of a method and of the mounting pose as one JSON object, in the tables of
/// `flagstone config`. Infinity is "inf" or "-inf", because JSON
/// does not have it.
std::string to_json(ResolvedMethod method);

}  // namespace flagstone::config

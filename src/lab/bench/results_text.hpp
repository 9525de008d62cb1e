// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lab/bench/results.hpp"

namespace flagstone::bench {

/// Results as tables, with what they were measured on above them.
[[nodiscard]] std::string to_text(const Results& results);

}  // namespace flagstone::bench

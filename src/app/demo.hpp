// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace flagstone::app {

struct DemoRequest {
  std::string output = "flagstone-demo";  ///< folder; made if missing
  std::uint64_t seed = 7;                 ///< which street
};

/// Simulates a street, segments it by surface, writes scan, truth and labels as a SemanticKITTI
/// sequence, and draws pictures if rendering is available. Returns what came out, for people.
/// Throws std::invalid_argument if the folder contains a scan that no demo wrote,
/// std::runtime_error for a file that cannot be written.
std::string run_demo(const DemoRequest& request);

}  // namespace flagstone::app

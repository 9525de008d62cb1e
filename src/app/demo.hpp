// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace flagstone::app {

struct DemoRequest {
  std::string output = "flagstone-demo";  ///< directory, created if it does not exist
  std::uint64_t seed = 7;                 ///< random seed of the street
};

/// Simulates a street, segments it with the method `surface`, writes the scan, its ground truth and
/// its labels as a SemanticKITTI sequence, and draws images if rendering is available. Returns the
/// results as text. Throws std::invalid_argument if the directory contains a scan that no demo
/// wrote, std::runtime_error if a file cannot be written.
std::string run_demo(const DemoRequest& request);

}  // namespace flagstone::app

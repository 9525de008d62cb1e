// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/eval/height_score.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::eval {

/// What one method made of one scan.
struct MethodOutcome {
  std::optional<std::string> error;  ///< one line; nothing else is filled then
  Score score;
  std::optional<HeightScore> heights;  ///< of methods that give heights where the truth is known
  std::optional<double> segment_ms;    ///< none for labels made elsewhere
};

/// What became of one scan.
struct ScanOutcome {
  std::optional<std::string> error;  ///< the scan or its truth could not be read: one line
  std::vector<MethodOutcome> methods;
  double read_ms = 0;   ///< points and classes
  double score_ms = 0;  ///< truth and all scores
};

}  // namespace flagstone::eval

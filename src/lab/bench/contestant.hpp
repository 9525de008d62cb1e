// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/stage_times.hpp"

namespace flagstone::bench {

/// What came of one scan.
struct Visit {
  double milliseconds = 0;
  std::size_t ground = 0;  ///< points found ground
  StageTimes stages{};     ///< seconds; zeros where stages are not timed
};

/// Something that is timed on every scan in turn.
class Contestant {
 public:
  virtual ~Contestant() = default;
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;
  Contestant(Contestant&&) = delete;
  Contestant& operator=(Contestant&&) = delete;

  /// Does its work on scan number `scan`. Throws std::runtime_error, with one line, where it
  /// cannot.
  virtual Visit visit(std::size_t scan) = 0;

 protected:
  Contestant() = default;
};

}  // namespace flagstone::bench

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "lab/bench/bare_pass.hpp"
#include "lab/bench/contestant.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::bench {

/// The bare pass, with one instruction set.
class TimedBarePass final : public Contestant {
 public:
  TimedBarePass(std::span<const CloudView> scans, std::string target)
      : scans_(scans), target_(std::move(target)) {
    std::size_t largest = 0;
    for (const CloudView& scan : scans) largest = std::max(largest, scan.size());
    bytes_.resize(largest);
  }

  Visit visit(std::size_t scan) override {
    use_simd_target(target_);
    Stopwatch stopwatch;
    bare_pass(scans_[scan], bytes_);
    return {.milliseconds = stopwatch.lap()};
  }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace flagstone::bench

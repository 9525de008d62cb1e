// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/timed_segment.hpp"

#include <stdexcept>
#include <utility>

#include "lab/bench/allocation_count.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::bench {
namespace {

/// The name, once it is in use: whatever a method prepares when it is made is prepared for it.
std::string used(std::string target) {
  use_simd_target(target);
  return target;
}

}  // namespace

TimedSegment::TimedSegment(std::span<const CloudView> scans, const TimedConfig& config,
                           const MountSettings& mount, unsigned threads, std::string target,
                           Stages stages)
    : scans_(scans),
      target_(used(std::move(target))),
      segmenter_(
          make_timed(config, mount, threads, stages == Stages::timed ? &stage_times_ : nullptr)) {}

Visit TimedSegment::visit(std::size_t scan) {
  use_simd_target(target_);
  stage_times_ = {};
  const std::size_t calls_before = allocation_count().calls;
  Stopwatch stopwatch;
  const Status status = segmenter_->segment(scans_[scan], result_);
  const double milliseconds = stopwatch.lap();
  allocations_ = allocation_count().calls - calls_before;
  if (status.code() == StatusCode::out_of_memory) {
    throw std::runtime_error("not enough memory to segment a scan; bench fewer at a time");
  }
  if (!status.ok()) throw std::runtime_error(status.message());
  return {
      .milliseconds = milliseconds, .ground = result_.count(Label::ground), .stages = stage_times_};
}

}  // namespace flagstone::bench

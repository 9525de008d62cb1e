// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"
#include "spare_results.hpp"

namespace flagstone::python {

/// One segmented scan, for Python to look into. Arrays that Python has of it keep it alive; when
/// the last is gone its memory serves another scan.
class Result {
 public:
  Result(std::unique_ptr<Segmentation> segmentation, std::shared_ptr<SpareResults> spare,
         const Mount& mount, const MountDecision& decision)
      : segmentation_(std::move(segmentation)),
        spare_(std::move(spare)),
        mount_(mount),
        decision_(decision) {}
  ~Result() {
    if (segmentation_) spare_->give_back(std::move(segmentation_));
  }
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;
  Result(Result&&) = delete;
  Result& operator=(Result&&) = delete;

  [[nodiscard]] const Segmentation& segmentation() const noexcept { return *segmentation_; }
  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }
  [[nodiscard]] const MountDecision& decision() const noexcept { return decision_; }

  /// 1 for each point of the ground, else 0. May throw std::bad_alloc, the first time.
  [[nodiscard]] std::span<const std::uint8_t> ground();

  /// The heights; all NaN where the method has none. May throw std::bad_alloc, the first time.
  [[nodiscard]] std::span<const float> heights();

 private:
  std::unique_ptr<Segmentation> segmentation_;
  std::shared_ptr<SpareResults> spare_;
  Mount mount_;
  MountDecision decision_;
  std::vector<std::uint8_t> ground_;
  std::vector<float> unknown_heights_;
};

}  // namespace flagstone::python

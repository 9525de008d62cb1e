// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flagstone/mount.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone::python {

/// Pool of unused results, so that `segment` reuses their memory and does not allocate after the
/// first scans, as in C++. Thread-safe. Neither function waits for the lock, so a mutex that was
/// locked during a fork cannot block the child.
class SpareResults {
 public:
  SpareResults() { spare_.reserve(max_kept); }

  std::unique_ptr<Segmentation> take() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || spare_.empty()) return std::make_unique<Segmentation>();
    std::unique_ptr<Segmentation> result = std::move(spare_.back());
    spare_.pop_back();
    return result;
  }

  void give_back(std::unique_ptr<Segmentation> result) noexcept {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && spare_.size() < max_kept) spare_.push_back(std::move(result));
  }

 private:
  static constexpr std::size_t max_kept = 2;

  std::mutex mutex_;
  std::vector<std::unique_ptr<Segmentation>> spare_;
};

/// Result of one scan in Python. NumPy arrays that view its memory keep it alive. When the last
/// reference is gone, its memory returns to the pool.
class Result {
 public:
  Result(std::unique_ptr<Segmentation> segmentation, std::shared_ptr<SpareResults> spare,
         const Mount& mount, const MountDecision& decision)
      : segmentation_(std::move(segmentation)),
        spare_(std::move(spare)),
        mount_(mount),
        decision_(decision) {}

  /// A result from a pickle, which contains the decision in words.
  Result(std::unique_ptr<Segmentation> segmentation, const Mount& mount, std::string decision)
      : segmentation_(std::move(segmentation)),
        mount_(mount),
        decision_in_words_(std::move(decision)) {}

  ~Result() {
    if (spare_) spare_->give_back(std::move(segmentation_));
  }
  Result(const Result&) = delete;
  Result& operator=(const Result&) = delete;
  Result(Result&&) = delete;
  Result& operator=(Result&&) = delete;

  [[nodiscard]] const Segmentation& segmentation() const noexcept { return *segmentation_; }
  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }

  /// How the mounting pose was determined, in one sentence.
  [[nodiscard]] std::string decision() const {
    return decision_in_words_.empty() ? to_sentence(decision_) : decision_in_words_;
  }

  /// 1 for each ground point, otherwise 0. The first call may throw std::bad_alloc.
  [[nodiscard]] std::span<const std::uint8_t> ground() {
    const std::span<const Label> labels = segmentation_->labels();
    if (ground_.size() != labels.size()) {
      ground_.resize(labels.size());
      std::ranges::transform(labels, ground_.begin(), [](Label label) {
        return static_cast<std::uint8_t>(label == Label::ground);
      });
    }
    return ground_;
  }

  /// Heights; all NaN if the method does not compute them. The first call may throw std::bad_alloc.
  [[nodiscard]] std::span<const float> heights() {
    const std::size_t points = segmentation_->labels().size();
    if (segmentation_->heights().size() == points) return segmentation_->heights();
    unknown_heights_.resize(points, std::numeric_limits<float>::quiet_NaN());
    return unknown_heights_;
  }

 private:
  std::unique_ptr<Segmentation> segmentation_;
  std::shared_ptr<SpareResults> spare_;
  Mount mount_;
  MountDecision decision_;
  std::string decision_in_words_;
  std::vector<std::uint8_t> ground_;
  std::vector<float> unknown_heights_;
};

}  // namespace flagstone::python

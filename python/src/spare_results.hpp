// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "flagstone/segmentation.hpp"

namespace flagstone::python {

/// Results nobody holds any more, kept so that the next scan finds their memory grown: a scan after
/// the first ones allocates nothing, as in C++. Any thread may take and give back.
class SpareResults {
 public:
  std::unique_ptr<Segmentation> take() {
    const std::scoped_lock lock(mutex_);
    if (spare_.empty()) return std::make_unique<Segmentation>();
    std::unique_ptr<Segmentation> result = std::move(spare_.back());
    spare_.pop_back();
    return result;
  }

  void give_back(std::unique_ptr<Segmentation> result) noexcept {
    const std::scoped_lock lock(mutex_);
    if (spare_.size() < most_kept) spare_.push_back(std::move(result));
  }

 private:
  static constexpr std::size_t most_kept = 2;

  std::mutex mutex_;
  std::vector<std::unique_ptr<Segmentation>> spare_ = with_room();

  static std::vector<std::unique_ptr<Segmentation>> with_room() {
    std::vector<std::unique_ptr<Segmentation>> spare;
    spare.reserve(most_kept);
    return spare;
  }
};

}  // namespace flagstone::python

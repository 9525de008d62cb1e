// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace flagstone_ros {

/// A queue between the thread that receives clouds and the thread that segments them. If it is
/// full, the oldest element is dropped. Thread-safe.
template <class Element>
class LatestQueue {
 public:
  /// `depth`: maximum number of elements, at least 1.
  explicit LatestQueue(std::size_t depth) : depth_(depth) {}

  /// Adds an element. Returns whether the oldest one was dropped for it.
  bool push(Element element) {
    std::optional<Element> dropped;  // destroyed after the lock is released
    {
      const std::scoped_lock lock(mutex_);
      if (elements_.size() == depth_) {
        dropped = std::move(elements_.front());
        elements_.pop_front();
      }
      elements_.push_back(std::move(element));
    }
    changed_.notify_one();
    return dropped.has_value();
  }

  /// Waits for an element and removes it. Nothing once the queue is closed.
  std::optional<Element> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_closed_ || !elements_.empty(); });
    if (is_closed_) return std::nullopt;
    std::optional<Element> element = std::move(elements_.front());
    elements_.pop_front();
    return element;
  }

  /// Ends all waiting.
  void close() {
    {
      const std::scoped_lock lock(mutex_);
      is_closed_ = true;
    }
    changed_.notify_all();
  }

 private:
  const std::size_t depth_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Element> elements_;
  bool is_closed_ = false;
};

}  // namespace flagstone_ros

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/thread_pool.hpp"

#include <exception>

#include "library/core/floating_point_mode.hpp"

namespace flagstone {
namespace {

/// Looks at `value` so many times, then sleeps until it is no longer `old`.
void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old, int looks) noexcept {
  for (int look = 0; look < looks; ++look) {
    if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
  }
  while (value.load(std::memory_order_acquire) == old) value.wait(old, std::memory_order_acquire);
}

}  // namespace

ThreadPool::ThreadPool(unsigned size) {
  // Some ten microseconds; none where threads would take cores from each other.
  looks_ = size <= std::thread::hardware_concurrency() ? 1000 : 0;
  others_.reserve(size - 1);
  try {
    for (unsigned worker = 1; worker < size; ++worker) {
      others_.emplace_back([this, worker] { serve(worker); });
    }
  } catch (const std::exception&) {
    return;  // no more threads, or no memory for them: fewer do as well
  }
}

ThreadPool::~ThreadPool() {
  dismissed_ = true;
  ++round_;
  round_.notify_all();
  for (std::thread& other : others_) other.join();
}

void ThreadPool::run_together() noexcept {
  next_.store(0, std::memory_order_relaxed);
  at_work_.store(static_cast<std::uint32_t>(others_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  take_jobs(0);
  for (std::uint32_t left = at_work_.load(std::memory_order_acquire); left != 0;
       left = at_work_.load(std::memory_order_acquire)) {
    wait_while(at_work_, left, looks_);
  }
}

void ThreadPool::take_jobs(std::size_t worker) noexcept {
  for (std::size_t job = next_++; job < count_; job = next_++) call_(context_, worker, job);
}

void ThreadPool::serve(std::size_t worker) noexcept {
  const ScopedFloatingPointMode own;
  for (std::uint32_t round = 0;;) {
    wait_while(round_, round, looks_);
    round = round_.load(std::memory_order_acquire);
    if (dismissed_) return;
    take_jobs(worker);
    at_work_.fetch_sub(1, std::memory_order_release);
    at_work_.notify_one();
  }
}

}  // namespace flagstone

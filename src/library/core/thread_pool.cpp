// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/thread_pool.hpp"

#include <pthread.h>

#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "library/core/floating_point_mode.hpp"

namespace flagstone {
namespace {

/// Number of forks between this process and the process that registered the handler.
std::atomic<std::uint32_t> forks = 0;

/// Checks `value` up to `spin_count` times, then blocks until it differs from `old`.
void wait_while(const std::atomic<std::uint32_t>& value, std::uint32_t old,
                int spin_count) noexcept {
  for (int spin = 0; spin < spin_count; ++spin) {
    if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
  }
  while (value.load(std::memory_order_acquire) == old) value.wait(old, std::memory_order_acquire);
}

}  // namespace

unsigned checked_threads(std::string_view where, unsigned threads) {
  if (threads >= 1 && threads <= max_threads) return threads;
  throw std::invalid_argument(std::string(where) + ": threads = " + std::to_string(threads) +
                              " is out of range (expected 1 to " + std::to_string(max_threads) +
                              ")");
}

unsigned threads_or_cores(unsigned threads) noexcept {
  return threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
}

ThreadPool::ThreadPool(unsigned size) {
#ifndef __wasi__  // WebAssembly has no fork()
  // The fork handler is registered once, by the first pool.
  static const int registered =
      pthread_atfork(nullptr, nullptr, [] { forks.fetch_add(1, std::memory_order_relaxed); });
  static_cast<void>(registered);
#endif
  // About ten microseconds. No spinning if there are more threads than cores.
  spin_count_ = size <= std::thread::hardware_concurrency() ? 1000 : 0;
  workers_.reserve(size - 1);
  start_workers(size - 1);
}

ThreadPool::~ThreadPool() {
  if (has_forked()) forget_workers();
  stopping_ = true;
  ++round_;
  round_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::start_workers(std::size_t count) noexcept {
  forks_ = forks.load(std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed);
  try {
    while (workers_.size() < count) {
      const std::size_t worker = workers_.size() + 1;
      workers_.emplace_back([this, worker, round] { worker_loop(worker, round); });
    }
  } catch (const std::exception&) {
    return;  // no more threads, or no memory for them: continue with fewer
  }
}

bool ThreadPool::has_forked() const noexcept {
  return forks.load(std::memory_order_relaxed) != forks_;
}

/// A fork() copies the pool but not its threads, which can then be neither joined nor detached.
void ThreadPool::forget_workers() noexcept {
  for (std::thread& worker : workers_) std::construct_at(&worker);
  workers_.clear();
}

void ThreadPool::run_together() noexcept {
  if (has_forked()) {
    const std::size_t count = workers_.size();
    forget_workers();
    start_workers(count);
  }
  next_.store(0, std::memory_order_relaxed);
  active_.store(static_cast<std::uint32_t>(workers_.size()), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  take_jobs(0);
  for (std::uint32_t left = active_.load(std::memory_order_acquire); left != 0;
       left = active_.load(std::memory_order_acquire)) {
    wait_while(active_, left, spin_count_);
  }
}

void ThreadPool::take_jobs(std::size_t worker) noexcept {
  for (std::size_t job = next_++; job < count_; job = next_++) call_(context_, worker, job);
}

/// `round` is the last round before the worker was started.
void ThreadPool::worker_loop(std::size_t worker, std::uint32_t round) noexcept {
  const ScopedFloatingPointMode mode;
  for (;;) {
    wait_while(round_, round, spin_count_);
    round = round_.load(std::memory_order_acquire);
    if (stopping_) return;
    take_jobs(worker);
    active_.fetch_sub(1, std::memory_order_release);
    active_.notify_one();
  }
}

std::size_t run_on_threads(unsigned threads, const std::function<void()>& work) {
  const ScopedFloatingPointMode mode;  // the caller gets the mode of the workers
  ThreadPool pool(threads);
  pool.run(pool.size(), [&](std::size_t, std::size_t) { work(); });
  return pool.size();
}

}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace flagstone {

/// Threads that work on one scan together. They are started once; in between they watch for work
/// for some microseconds, so that the next step of a scan finds them awake, and then sleep. They
/// have their ScopedFloatingPointMode (see there); the thread that calls `run` does as it likes.
class ThreadPool {
 public:
  /// `size` >= 1 counts the thread that calls `run`. May throw std::bad_alloc; where the system has
  /// no more threads, or no memory for them, the crew is smaller.
  explicit ThreadPool(unsigned size);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// How many work together.
  [[nodiscard]] std::size_t size() const noexcept { return others_.size() + 1; }

  /// Calls `work(worker, job)` for the jobs 0 to `count` - 1, each once, in any order, from threads
  /// that are the workers 0 to size() - 1; worker 0 is the caller. Returns when all are done.
  template <class Work>
  void run(std::size_t count, const Work& work) noexcept {
    if (others_.empty() || count <= 1) {
      for (std::size_t job = 0; job < count; ++job) work(std::size_t{0}, job);
      return;
    }
    count_ = count;
    context_ = &work;
    call_ = [](const void* context, std::size_t worker, std::size_t job) noexcept {
      (*static_cast<const Work*>(context))(worker, job);
    };
    run_together();
  }

 private:
  using Call = void (*)(const void* context, std::size_t worker, std::size_t job) noexcept;

  void run_together() noexcept;
  void take_jobs(std::size_t worker) noexcept;
  void serve(std::size_t worker) noexcept;

  std::vector<std::thread> others_;
  std::size_t count_ = 0;
  const void* context_ = nullptr;
  Call call_ = nullptr;
  int looks_ = 0;                           ///< how long to watch before sleeping
  std::atomic<std::size_t> next_ = 0;       ///< job
  std::atomic<std::uint32_t> round_ = 0;    ///< raised when there is work
  std::atomic<std::uint32_t> at_work_ = 0;  ///< other threads that are not done with the round
  std::atomic<bool> dismissed_ = false;
};

}  // namespace flagstone

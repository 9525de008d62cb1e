// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// All multi-threaded code in flagstone uses one of these two:
//
//     ThreadPool pool(4);                    // started once; for the short steps of one scan
//     pool.run(count, [&](std::size_t worker, std::size_t job) noexcept { ... });
//
//     parallel_for(count, 4, interrupted, [&] {  // for long jobs: scans, files, simulated frames
//       return [reader = Reader()](std::size_t job) mutable { ... };  // may throw
//     });
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

namespace flagstone {

/// The largest number of threads that can be requested; the smallest is 1.
inline constexpr unsigned max_threads = 1024;

/// Returns `threads`. Throws std::invalid_argument if it is not 1 to `max_threads`; the message
/// begins with `where`, such as "surface".
unsigned checked_threads(std::string_view where, unsigned threads);

/// Returns `threads`, or the number of cores if it is 0.
unsigned threads_or_cores(unsigned threads) noexcept;

/// A fixed-size thread pool. Between jobs, workers spin for a few microseconds so that the next
/// step of a scan finds them awake, and then block. Workers set the floating-point mode (see
/// ScopedFloatingPointMode); the calling thread is left as it is.
///
/// After a fork() the child starts its own workers at its first `run`.
class ThreadPool {
 public:
  /// `size` >= 1 includes the thread that calls `run`. May throw std::bad_alloc. If the system has
  /// no more threads, or no memory for them, the pool is smaller.
  explicit ThreadPool(unsigned size);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// Number of threads, including the caller's. It never grows.
  [[nodiscard]] std::size_t size() const noexcept { return workers_.size() + 1; }

  /// Calls `work(worker, job)` once for each job from 0 to `count` - 1, in any order. `worker` is
  /// the number of the thread, 0 to size() - 1; the caller is worker 0. Returns when all jobs are
  /// finished. `work` must not throw. Not thread-safe.
  template <class Work>
  void run(std::size_t count, const Work& work) noexcept {
    if (workers_.empty() || count <= 1) {
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

  void start_workers(std::size_t count) noexcept;
  void forget_workers() noexcept;
  [[nodiscard]] bool has_forked() const noexcept;
  void run_together() noexcept;
  void take_jobs(std::size_t worker) noexcept;
  void worker_loop(std::size_t worker, std::uint32_t round) noexcept;

  std::vector<std::thread> workers_;
  std::uint32_t forks_ = 0;  ///< forks before the workers were started
  std::size_t count_ = 0;
  const void* context_ = nullptr;
  Call call_ = nullptr;
  int spin_count_ = 0;                     ///< number of checks before blocking
  std::atomic<std::size_t> next_ = 0;      ///< job
  std::atomic<std::uint32_t> round_ = 0;   ///< raised when there is work
  std::atomic<std::uint32_t> active_ = 0;  ///< workers that have not finished the round
  std::atomic<bool> stopping_ = false;
};

/// Calls `work` on up to `threads` threads at once, including the caller's. `work` must not throw.
/// Returns the number of threads.
std::size_t run_on_threads(unsigned threads, const std::function<void()>& work);

/// A `stop` for parallel_for that never stops.
inline constexpr auto never_stop = [] { return false; };

/// Distributes the jobs 0 to `count` - 1, in this order, to at most `threads` threads (0: all
/// cores), including the caller's. Each thread that gets a job calls `make_worker()` once and
/// passes the job numbers to the result, which may keep state and may throw. After `stop()` returns
/// true or a job throws, no more jobs are started. The first exception is rethrown here when all
/// threads have finished. All threads use the ScopedFloatingPointMode. Returns the number of
/// threads.
template <class Stop, class MakeWorker>
std::size_t parallel_for(std::size_t count, unsigned threads, const Stop& stop,
                         const MakeWorker& make_worker) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&]() noexcept {
    try {
      std::size_t job = stop() ? count : next++;
      if (job >= count) return;
      for (auto worker = make_worker(); job < count; job = stop() ? count : next++) worker(job);
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  const std::size_t useful = std::clamp<std::size_t>(count, 1, threads_or_cores(threads));
  const std::size_t used = run_on_threads(static_cast<unsigned>(useful), work);
  if (failure) std::rethrow_exception(failure);
  return used;
}

}  // namespace flagstone

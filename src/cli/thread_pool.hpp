// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/interrupt.hpp"

namespace flagstone::cli {

/// How many threads "0, all cores" means.
inline unsigned thread_count(unsigned asked) {
  return asked != 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

/// Gives the jobs 0 to `count` - 1 out, in that order, to `threads` threads (0: all cores; fewer
/// where the system has no more) until all are done or somebody asks to stop. `make_worker()` is
/// called once in each thread, and what it returns with the number of each job. Once one of them
/// throws, no more jobs are given out and the first exception is thrown from here. Returns how many
/// threads there were.
template <class MakeWorker>
std::size_t run_crew(std::size_t count, unsigned threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&]() noexcept {
    try {
      auto worker = make_worker();
      while (!interrupted()) {
        const std::size_t job = next++;
        if (job >= count) return;
        worker(job);
      }
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::size_t members = 1;
  {
    const std::size_t size = std::min<std::size_t>(thread_count(threads), count);
    std::vector<std::jthread> others;
    others.reserve(size);
    bool there_are_more = true;
    while (there_are_more && others.size() + 1 < size) {
      try {
        others.emplace_back(work);
        ++members;
      } catch (const std::system_error&) {
        there_are_more = false;
      }
    }
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return members;
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "cli/interrupt.hpp"

namespace flagstone::cli {

/// How many threads "0, all cores" means.
inline unsigned thread_count(unsigned asked) {
  return asked != 0 ? asked : std::max(1u, std::thread::hardware_concurrency());
}

/// Gives the jobs 0 to `count` - 1 out, in that order, to `threads` threads (0: all cores) until
/// all are done or somebody asks to stop. `make_worker()` is called once in each thread; what it
/// returns is called with the number of a job and must not throw.
template <class MakeWorker>
void run_crew(std::size_t count, unsigned threads, const MakeWorker& make_worker) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    auto worker = make_worker();
    while (!interrupted()) {
      const std::size_t job = next++;
      if (job >= count) return;
      worker(job);
    }
  };
  const std::size_t size = std::min<std::size_t>(thread_count(threads), count);
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < size; ++i) others.emplace_back(work);
  work();
}

}  // namespace flagstone::cli

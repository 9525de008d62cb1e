// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Runs long work: over many files, on several threads, with progress, and stoppable by the caller.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "library/core/thread_pool.hpp"

namespace flagstone::app {

/// Progress of a run.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string_view unit = "scans";
  std::optional<double> seconds_left{};  ///< unknown until the first job is done
};

/// "40 of 100 scans, 12 s left", after a bar if there is room; at most `columns` wide.
std::string to_text(const Progress& progress, std::size_t columns);

/// Functions that a run calls, from one thread at a time. Each may be empty.
struct RunCallbacks {
  std::function<void(const Progress&)> progress{};         ///< called first with nothing done
  std::function<void(const std::string& line)> message{};  ///< a problem, or a decision
  std::function<bool()> stop{};  ///< true: finish the jobs in progress and return; thread-safe

  void show(const Progress& at) const {
    if (progress) progress(at);
  }
  void say(const std::string& line) const {
    if (message) message(line);
  }
  [[nodiscard]] bool stopped() const { return stop && stop(); }
};

/// Computes Progress from the number of finished jobs. The time left assumes that the remaining
/// jobs take as long per job.
class ProgressMeter {
 public:
  /// `first`: jobs that were done before, if the run is resumed.
  explicit ProgressMeter(std::size_t total, std::string_view unit = "scans", std::size_t first = 0)
      : total_(total), unit_(unit), first_(first) {}

  [[nodiscard]] Progress at(std::size_t done) const;

 private:
  std::size_t total_;
  std::string_view unit_;
  std::size_t first_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Outcome of a run.
struct RunOutcome {
  std::size_t done = 0;  ///< jobs; fewer than all if the caller stopped it
  std::size_t workers = 0;
};

/// Runs the jobs 0 to `count` - 1 on `threads` threads (0: all cores), see parallel_for.
/// Each thread calls `make_worker()` once and the worker with the number of each job. The report
/// that the worker returns goes to `deliver(job, report)`: in the order of the jobs, from one
/// thread at a time, in batches at most ten times per second. callbacks.progress follows each
/// batch.
template <class MakeWorker, class Deliver>
RunOutcome run_in_order(std::size_t count, unsigned threads, std::string_view unit,
                        const RunCallbacks& callbacks, const MakeWorker& make_worker,
                        const Deliver& deliver) {
  using Report = decltype(make_worker()(std::size_t{}));
  constexpr std::chrono::milliseconds pause{100};
  const ProgressMeter meter(count, unit);
  std::mutex mutex;
  std::map<std::size_t, Report> waiting;  // until the reports of earlier jobs are delivered
  std::size_t next = 0;                   // job to deliver next
  std::size_t done = 0;
  bool delivering = false;
  std::chrono::steady_clock::time_point next_delivery;

  const auto deliver_ready = [&](std::unique_lock<std::mutex>& lock, bool gaps_too) {
    delivering = true;
    std::vector<std::pair<std::size_t, Report>> ready;
    while (!waiting.empty() && (gaps_too || waiting.begin()->first == next)) {
      auto first = waiting.extract(waiting.begin());
      next = first.key() + 1;
      ready.emplace_back(first.key(), std::move(first.mapped()));
    }
    const std::size_t done_now = done;
    lock.unlock();  // so that other threads can continue
    for (auto& [job, report] : ready) deliver(job, std::move(report));
    callbacks.show(meter.at(done_now));
    lock.lock();
    delivering = false;
  };

  callbacks.show(meter.at(0));
  const std::size_t workers = parallel_for(
      count, threads, [&] { return callbacks.stopped(); },
      [&] {
        return [&, worker = make_worker()](std::size_t job) mutable {
          Report report = worker(job);
          std::unique_lock lock(mutex);
          waiting.emplace(job, std::move(report));
          ++done;
          const auto now = std::chrono::steady_clock::now();
          if (delivering || now < next_delivery) return;
          next_delivery = now + pause;
          deliver_ready(lock, false);
        };
      });
  std::unique_lock lock(mutex);
  deliver_ready(lock, true);
  return {.done = done, .workers = workers};
}

}  // namespace flagstone::app

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/thread_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "child_process.hpp"
#include "skip_on_windows.hpp"

namespace flagstone {
namespace {

using testing::Each;

/// Number of times that each job was run.
std::vector<int> times_done(ThreadPool& pool, std::size_t jobs) {
  std::vector<std::atomic<int>> done(jobs);
  pool.run(jobs, [&](std::size_t, std::size_t job) { ++done[job]; });
  return {done.begin(), done.end()};
}

class ThreadPoolOf : public testing::TestWithParam<unsigned> {
 protected:
  ThreadPool pool{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, ThreadPoolOf, testing::Range(1U, 9U),
                         testing::PrintToStringParamName());

TEST_P(ThreadPoolOf, IncludesTheCaller) { EXPECT_EQ(pool.size(), GetParam()); }

TEST_P(ThreadPoolOf, DoesEveryJobOnce) {
  for (const std::size_t jobs : {1U, 2U, 3U, 7U, 8U, 9U, 100U, 5000U}) {
    EXPECT_THAT(times_done(pool, jobs), Each(1)) << jobs << " jobs";
  }
}

TEST_P(ThreadPoolOf, DoesNothingWithoutJobs) {
  pool.run(0, [](std::size_t, std::size_t) { ADD_FAILURE() << "ran a job"; });
}

TEST_P(ThreadPoolOf, RunsAThousandRoundsWithoutLosingOrRepeatingAJob) {
  std::vector<std::atomic<std::size_t>> done(24);
  for (std::size_t round = 0; round < 1000; ++round) {
    const std::size_t jobs = round % done.size() + 1;
    pool.run(jobs, [&](std::size_t, std::size_t job) { ++done[job]; });
  }

  for (std::size_t job = 0; job < done.size(); ++job) {
    std::size_t rounds_with_it = 0;
    for (std::size_t round = 0; round < 1000; ++round) rounds_with_it += round % 24 + 1 > job;
    EXPECT_EQ(done[job], rounds_with_it) << "job " << job;
  }
}

TEST_P(ThreadPoolOf, HasFinishedAllJobsWhenRunReturns) {
  // Not atomic: values written by other threads must be visible without further synchronisation.
  std::vector<std::size_t> squares(2000);
  for (std::size_t factor = 1; factor <= 50; ++factor) {
    pool.run(squares.size(),
             [&](std::size_t, std::size_t job) { squares[job] = factor * job * job; });
    for (std::size_t job = 0; job < squares.size(); ++job) {
      ASSERT_EQ(squares[job], factor * job * job);
    }
  }
}

TEST_P(ThreadPoolOf, GivesEachWorkerAUniqueNumber) {
  std::vector<std::atomic<std::thread::id>> thread_of(pool.size());
  std::atomic<int> wrong = 0;
  for (int round = 0; round < 50; ++round) {
    pool.run(200, [&](std::size_t worker, std::size_t) {
      if (worker >= thread_of.size()) {
        ++wrong;
        return;
      }
      std::thread::id nobody;
      const std::thread::id self = std::this_thread::get_id();
      if (!thread_of[worker].compare_exchange_strong(nobody, self) && nobody != self) ++wrong;
    });
  }

  EXPECT_EQ(wrong, 0);
  const std::thread::id first = thread_of[0];
  EXPECT_TRUE(first == std::this_thread::get_id() || first == std::thread::id())
      << "worker 0 is the caller";
}

TEST_P(ThreadPoolOf, CanSleepBetweenRounds) {
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_THAT(times_done(pool, 64), Each(1));
  }
}

TEST_P(ThreadPoolOf, CanBeDestroyedUnused) {
  for (int i = 0; i < 50; ++i) const ThreadPool unused(GetParam());
}

TEST_P(ThreadPoolOf, CanBeDestroyedRightAfterAJob) {
  for (int i = 0; i < 50; ++i) {
    ThreadPool brief(GetParam());
    EXPECT_THAT(times_done(brief, 16), Each(1));
  }
}

TEST_P(ThreadPoolOf, CanRunFromAJobOfAnotherPool) {
  // Each outer worker has a separate pool, like the segmenters of a parallel program.
  std::deque<ThreadPool> inner;
  for (std::size_t i = 0; i < pool.size(); ++i) inner.emplace_back(GetParam());
  std::atomic<std::size_t> done = 0;

  pool.run(40, [&](std::size_t worker, std::size_t) {
    inner[worker].run(10, [&](std::size_t, std::size_t) { ++done; });
  });

  EXPECT_EQ(done, 400U);
}

TEST_P(ThreadPoolOf, StartsItsOwnWorkersAfterAFork) {
  FLAGSTONE_SKIP_ON_WINDOWS("fork()");
  EXPECT_THAT(times_done(pool, 100), Each(1));

  const int exit_code = tests::exit_code_of_child([&] {
    for (int round = 0; round < 20; ++round) {
      for (const int times : times_done(pool, 100)) {
        if (times != 1) return 1;
      }
    }
    // Also in a child of the child.
    return tests::exit_code_of_child(
        [&] { return times_done(pool, 3) == std::vector{1, 1, 1} ? 0 : 2; });
  });

  EXPECT_EQ(exit_code, 0);
  EXPECT_THAT(times_done(pool, 100), Each(1)) << "the workers of the parent still exist";
}

TEST_P(ThreadPoolOf, CanBeDestroyedInAChildProcessThatDidNotUseIt) {
  FLAGSTONE_SKIP_ON_WINDOWS("fork()");
  auto copied = std::make_unique<ThreadPool>(GetParam());
  EXPECT_EQ(tests::exit_code_of_child([&] {
              copied.reset();
              return 0;
            }),
            0);
}

TEST(ThreadCount, IsOneToMaxThreads) {
  EXPECT_EQ(checked_threads("here", 1), 1U);
  EXPECT_EQ(checked_threads("here", max_threads), 1024U);
  for (const unsigned threads : {0U, 1025U}) {
    EXPECT_THAT(
        [&] { checked_threads("here", threads); },
        testing::ThrowsMessage<std::invalid_argument>("here: threads = " + std::to_string(threads) +
                                                      " is out of range (expected 1 to 1024)"));
  }
}

TEST(ThreadCount, IsTheNumberOfCoresForZero) {
  EXPECT_EQ(threads_or_cores(0), std::max(1U, std::thread::hardware_concurrency()));
  EXPECT_EQ(threads_or_cores(3), 3U);
}

TEST_P(ThreadPoolOf, ParallelForDoesEveryJobOnceWithAWorkerPerThread) {
  std::vector<std::atomic<int>> done(500);
  std::atomic<std::size_t> workers = 0;

  const std::size_t threads = parallel_for(done.size(), GetParam(), never_stop, [&] {
    ++workers;
    return [&](std::size_t job) { ++done[job]; };
  });

  EXPECT_THAT(std::vector<int>(done.begin(), done.end()), Each(1));
  EXPECT_EQ(threads, GetParam());
  EXPECT_GE(workers, 1U);
  EXPECT_LE(workers, GetParam());
}

TEST_P(ThreadPoolOf, ParallelForUsesNoMoreThreadsThanJobs) {
  const auto make_worker = [] { return [](std::size_t) {}; };
  EXPECT_EQ(parallel_for(2, GetParam(), never_stop, make_worker), std::min(2U, GetParam()));
  EXPECT_EQ(parallel_for(0, GetParam(), never_stop, make_worker), 1U);
}

TEST_P(ThreadPoolOf, ParallelForRethrowsTheFirstExceptionAndStartsNoMoreJobs) {
  std::atomic<std::size_t> done = 0;
  const auto run = [&] {
    parallel_for(100'000, GetParam(), never_stop, [&] {
      return [&](std::size_t job) {
        ++done;
        if (job == 3) throw std::runtime_error("job 3");
        // The other threads are still busy when the exception arrives, even if the thread of job 3
        // has to wait for a core.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      };
    });
  };

  EXPECT_THAT(run, testing::ThrowsMessage<std::runtime_error>("job 3"));
  EXPECT_LT(done, 100'000U);
}

TEST_P(ThreadPoolOf, ParallelForRethrowsAnExceptionOfMakeWorker) {
  const auto make_worker = [&]() -> std::function<void(std::size_t)> {
    throw std::runtime_error("no worker");
  };
  EXPECT_THAT([&] { parallel_for(5, GetParam(), never_stop, make_worker); },
              testing::ThrowsMessage<std::runtime_error>("no worker"));
}

TEST_P(ThreadPoolOf, ParallelForStopsWhenStopReturnsTrue) {
  std::atomic<std::size_t> done = 0;
  parallel_for(
      100'000, GetParam(), [&] { return done >= 10; },
      [&] { return [&](std::size_t) { ++done; }; });
  EXPECT_GE(done, 10U);
  EXPECT_LE(done, 10U + GetParam());
}

}  // namespace
}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/thread_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <deque>
#include <thread>
#include <vector>

namespace flagstone {
namespace {

using testing::Each;

/// How often each job was done.
std::vector<int> times_done(ThreadPool& crew, std::size_t jobs) {
  std::vector<std::atomic<int>> done(jobs);
  crew.run(jobs, [&](std::size_t, std::size_t job) { ++done[job]; });
  return {done.begin(), done.end()};
}

class CrewOf : public testing::TestWithParam<unsigned> {
 protected:
  ThreadPool crew{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Threads, CrewOf, testing::Range(1U, 9U),
                         testing::PrintToStringParamName());

TEST_P(CrewOf, CountsTheCaller) { EXPECT_EQ(crew.size(), GetParam()); }

TEST_P(CrewOf, DoesEveryJobOnce) {
  for (const std::size_t jobs : {1U, 2U, 3U, 7U, 8U, 9U, 100U, 5000U}) {
    EXPECT_THAT(times_done(crew, jobs), Each(1)) << jobs << " jobs";
  }
}

TEST_P(CrewOf, DoesNothingWhereThereAreNoJobs) {
  crew.run(0, [](std::size_t, std::size_t) { ADD_FAILURE() << "there was no job"; });
}

TEST_P(CrewOf, WorksAThousandRoundsWithoutLosingOrRepeatingAJob) {
  std::vector<std::atomic<std::size_t>> done(24);
  for (std::size_t round = 0; round < 1000; ++round) {
    const std::size_t jobs = round % done.size() + 1;
    crew.run(jobs, [&](std::size_t, std::size_t job) { ++done[job]; });
  }

  for (std::size_t job = 0; job < done.size(); ++job) {
    std::size_t rounds_with_it = 0;
    for (std::size_t round = 0; round < 1000; ++round) rounds_with_it += round % 24 + 1 > job;
    EXPECT_EQ(done[job], rounds_with_it) << "job " << job;
  }
}

TEST_P(CrewOf, HasFinishedWhenRunReturns) {
  // Plain numbers: what the others wrote must be seen without any synchronisation of ours.
  std::vector<std::size_t> squares(2000);
  for (std::size_t factor = 1; factor <= 50; ++factor) {
    crew.run(squares.size(),
             [&](std::size_t, std::size_t job) { squares[job] = factor * job * job; });
    for (std::size_t job = 0; job < squares.size(); ++job) {
      ASSERT_EQ(squares[job], factor * job * job);
    }
  }
}

TEST_P(CrewOf, GivesEachWorkerANumberOfItsOwn) {
  std::vector<std::atomic<std::thread::id>> thread_of(crew.size());
  std::atomic<int> wrong = 0;
  for (int round = 0; round < 50; ++round) {
    crew.run(200, [&](std::size_t worker, std::size_t) {
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

TEST_P(CrewOf, MaySleepBetweenRounds) {
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_THAT(times_done(crew, 64), Each(1));
  }
}

TEST_P(CrewOf, CanBeDismissedWithoutEverHavingWorked) {
  for (int i = 0; i < 50; ++i) const ThreadPool unused(GetParam());
}

TEST_P(CrewOf, CanBeDismissedRightAfterWork) {
  for (int i = 0; i < 50; ++i) {
    ThreadPool brief(GetParam());
    EXPECT_THAT(times_done(brief, 16), Each(1));
  }
}

TEST_P(CrewOf, CanRunFromAJobOfAnotherCrew) {
  // Each outer worker has a crew of its own, as segmenters of a parallel program have.
  std::deque<ThreadPool> inner;
  for (std::size_t i = 0; i < crew.size(); ++i) inner.emplace_back(GetParam());
  std::atomic<std::size_t> done = 0;

  crew.run(40, [&](std::size_t worker, std::size_t) {
    inner[worker].run(10, [&](std::size_t, std::size_t) { ++done; });
  });

  EXPECT_EQ(done, 400U);
}

}  // namespace
}  // namespace flagstone

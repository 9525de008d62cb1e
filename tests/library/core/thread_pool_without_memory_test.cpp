// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// A separate program, because it makes allocations fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <new>
#include <vector>

#include "counted_allocation.hpp"
#include "library/core/thread_pool.hpp"

namespace flagstone {
namespace {

TEST(ThreadPoolWithoutMemory, IsSmallerOrFailsAndNeverLosesAJob) {
  for (std::size_t bytes = 0; bytes <= 400; bytes += 8) {
    std::vector<std::atomic<int>> done(20);
    io::allocated = 0;
    io::allowed = bytes;
    try {
      ThreadPool pool(8);
      io::allowed = io::unlimited;
      pool.run(done.size(), [&](std::size_t, std::size_t job) { ++done[job]; });
      EXPECT_TRUE(std::ranges::all_of(done, [](int times) { return times == 1; })) << bytes;
    } catch (const std::bad_alloc&) {
      io::allowed = io::unlimited;
      EXPECT_LT(bytes, 7 * sizeof(void*)) << "there was memory for a pool of one";
    }
  }
}

}  // namespace
}  // namespace flagstone

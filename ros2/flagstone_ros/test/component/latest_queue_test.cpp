// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "latest_queue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace flagstone_ros {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

TEST(LatestQueue, ReturnsElementsInTheirOrder) {
  LatestQueue<int> queue(3);
  EXPECT_FALSE(queue.push(1));
  EXPECT_FALSE(queue.push(2));

  EXPECT_THAT(queue.pop(), Optional(1));
  EXPECT_THAT(queue.pop(), Optional(2));
}

TEST(LatestQueue, DropsTheOldestElementIfItIsFull) {
  LatestQueue<int> queue(2);
  queue.push(1);
  queue.push(2);

  EXPECT_TRUE(queue.push(3));

  EXPECT_THAT(queue.pop(), Optional(2));
  EXPECT_THAT(queue.pop(), Optional(3));
}

TEST(LatestQueue, ReturnsNothingOnceItIsClosed) {
  LatestQueue<int> queue(2);
  queue.push(1);

  queue.close();

  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(LatestQueue, WakesAThreadThatWaits) {
  LatestQueue<int> queue(2);
  std::vector<int> received;
  std::thread reader([&] {
    while (const auto element = queue.pop()) {
      received.push_back(*element);
      if (*element == 7) queue.close();
    }
  });

  queue.push(7);

  reader.join();
  EXPECT_THAT(received, ElementsAre(7));
}

}  // namespace
}  // namespace flagstone_ros

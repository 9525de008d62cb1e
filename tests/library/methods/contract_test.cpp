// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Guarantees on threads, moves and large clouds, which only the methods of the library give. The
// guarantees of all methods are tested in tests/lab/baselines.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include "child_process.hpp"
#include "library/methods/methods.hpp"
#include "random_cloud.hpp"
#include "skip_on_windows.hpp"

namespace flagstone {
namespace {

using tests::random_cloud;
using tests::segmented;
using tests::view_of;

template <class Method>
class LibraryContract : public testing::Test {};

TYPED_TEST_SUITE(LibraryContract, tests::LibraryMethods);

TYPED_TEST(LibraryContract, RejectsThreadsOutside1To1024AndNamesTheNumber) {
  for (const unsigned threads : {0U, 1025U, 4294967295U}) {
    try {
      const TypeParam segmenter({}, threads);
      ADD_FAILURE() << threads << " threads were accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("threads = " + std::to_string(threads)));
      EXPECT_THAT(error.what(), testing::HasSubstr("1 to 1024"));
    }
  }
}

TYPED_TEST(LibraryContract, SegmentsWithManyMoreThreadsThanCores) {
  const std::vector<Point> cloud = random_cloud(20000, 16);
  TypeParam one;
  TypeParam many({}, 64);

  EXPECT_TRUE(tests::is_same(segmented(one, view_of(cloud)), segmented(many, view_of(cloud))));
}

TYPED_TEST(LibraryContract, AChildProcessSegmentsWithItsOwnThreads) {
  FLAGSTONE_SKIP_ON_WINDOWS("fork()");
  const std::vector<Point> cloud = random_cloud(40000, 16);  // enough for several threads
  TypeParam segmenter({}, 2);
  const auto before = segmented(segmenter, view_of(cloud));

  EXPECT_EQ(tests::exit_code_of_child([&] {
              return tests::is_same(segmented(segmenter, view_of(cloud)), before) ? 0 : 1;
            }),
            0);
}

TYPED_TEST(LibraryContract, AMovedSegmenterStillSegmentsWithItsSettings) {
  const std::vector<Point> cloud = random_cloud(3000, 15);
  auto config = TypeParam().config();
  config.sensor_height = 1.6f;
  TypeParam original(config, 2);
  TypeParam moved = std::move(original);

  EXPECT_EQ(moved.config().sensor_height, 1.6f);
  EXPECT_TRUE(tests::is_same(segmented(config, view_of(cloud)), segmented(moved, view_of(cloud))));
}

TYPED_TEST(LibraryContract, SegmentsTenMillionPoints) {
  const std::vector<Point> cloud = random_cloud(10'000'000, 13);
  TypeParam segmenter;
  Segmentation result;

  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  EXPECT_EQ(result.labels().size(), cloud.size());
  EXPECT_GT(result.count(Label::ground), cloud.size() / 2);
}

}  // namespace
}  // namespace flagstone

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Clouds in every kind of memory layout: `surface` says of them what it says of packed points, and
// nothing outside of the points is read. That every layout is read right: tests/library/patchwork.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "flagstone/surface.hpp"
#include "forced_target.hpp"
#include "guarded_memory.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::view_of;

/// Writes the points so that `CloudView(first, points.size(), layout)` sees them.
void write(const std::vector<Point>& points, std::byte* first, const CloudLayout& layout) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::byte* const record = first + static_cast<std::ptrdiff_t>(i) * layout.stride;
    std::memcpy(record + layout.x, &points[i].x, sizeof(float));
    std::memcpy(record + layout.y, &points[i].y, sizeof(float));
    std::memcpy(record + layout.z, &points[i].z, sizeof(float));
  }
}

std::vector<Point> first_of(const std::vector<Point>& points, std::size_t count) {
  return {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// The parameter is the instruction set.
class SurfaceLayouts : public testing::TestWithParam<std::string> {
 protected:
  /// What is seen through `layout` from `first` on is segmented like the packed points.
  void expect_same_as_packed(const std::vector<Point>& points, std::byte* first,
                             const CloudLayout& layout) {
    write(points, first, layout);
    const tests::SurfaceOutcome expected = tests::segmented(packed_, view_of(points));
    EXPECT_TRUE(
        tests::is_same(expected, tests::segmented(other_, CloudView(first, points.size(), layout))))
        << points.size() << " points, stride " << layout.stride << ", x at " << layout.x;
  }

 private:
  tests::ForcedTarget forced_{GetParam()};
  Surface packed_;
  Surface other_;
};

INSTANTIATE_TEST_SUITE_P(On, SurfaceLayouts, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SurfaceLayouts, ForwardsThroughMemory) {
  for (const CloudLayout& layout : {CloudLayout{.stride = 12, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 1, .y = 5, .z = 9},
                                    CloudLayout{.stride = 20, .x = 8, .y = 4, .z = 0},
                                    CloudLayout{.stride = 13, .x = 1, .y = 5, .z = 9}}) {
    for (const std::size_t size : {1U, 15U, 16U, 17U, 1000U, 8193U}) {
      std::vector<std::byte> memory(size * static_cast<std::size_t>(layout.stride) + 16,
                                    std::byte{0xA5});
      expect_same_as_packed(corrupted_cloud(size, 3), memory.data(), layout);
    }
  }
}

TEST_P(SurfaceLayouts, BackwardsThroughMemory) {
  for (const std::size_t size : {1U, 16U, 33U, 8193U}) {
    std::vector<std::byte> memory(16 * size, std::byte{0xA5});
    expect_same_as_packed(corrupted_cloud(size, 3), memory.data() + 16 * (size - 1),
                          {.stride = -16, .x = 0, .y = 4, .z = 8});
  }
}

TEST_P(SurfaceLayouts, Planar) {
  for (const std::size_t size : {1U, 16U, 33U, 8193U}) {
    std::vector<std::byte> memory(12 * size);
    const auto plane = static_cast<std::ptrdiff_t>(4 * size);
    expect_same_as_packed(corrupted_cloud(size, 3), memory.data(),
                          {.stride = 4, .x = 0, .y = plane, .z = 2 * plane});
  }
}

TEST_P(SurfaceLayouts, AllPointsInOneRecord) {
  std::vector<std::byte> memory(12);
  expect_same_as_packed(std::vector<Point>(500, Point{6.1f, 2.3f, -1.7f}), memory.data(),
                        {.stride = 0, .x = 0, .y = 4, .z = 8});
}

TEST_P(SurfaceLayouts, NothingIsReadBehindTheLastCoordinate) {
  const tests::GuardedMemory memory(std::size_t{8210} * 20);
  const std::vector<Point> points = corrupted_cloud(8210, 6);
  for (const CloudLayout& layout : {CloudLayout{.stride = 12, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 4, .y = 8, .z = 12},
                                    CloudLayout{.stride = 20, .x = 0, .y = 4, .z = 8}}) {
    const auto expect_same_at_the_end = [&](std::size_t size) {
      // Ends with the last z, though the record of 16 or 20 bytes would go on.
      const std::size_t bytes = (size - 1) * static_cast<std::size_t>(layout.stride) +
                                static_cast<std::size_t>(layout.z) + sizeof(float);
      expect_same_as_packed(first_of(points, size), memory.last(bytes).data(), layout);
    };
    for (std::size_t size = 1; size <= 40; ++size) expect_same_at_the_end(size);
    for (const std::size_t size : {8191U, 8192U, 8193U, 8210U}) expect_same_at_the_end(size);
  }
}

TEST_P(SurfaceLayouts, NothingIsReadBeforeTheFirstCoordinate) {
  const tests::GuardedMemory memory(std::size_t{20} * 40);
  for (const std::ptrdiff_t stride : {12, 16, 20}) {
    for (std::size_t size = 1; size <= 40; ++size) {
      // Point 0 is the last in memory, and x the first number of its record.
      std::byte* const first =
          memory.first(1).data() + (size - 1) * static_cast<std::size_t>(stride);
      expect_same_as_packed(corrupted_cloud(size, 6), first,
                            {.stride = -stride, .x = 0, .y = 4, .z = 8});
    }
  }
}

}  // namespace
}  // namespace flagstone

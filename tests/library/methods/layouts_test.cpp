// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Clouds in every memory layout: the result is the same as for packed points, and no memory outside
// the points is read.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

#include "forced_target.hpp"
#include "guarded_memory.hpp"
#include "library/methods/methods.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::view_of;

/// Writes the points so that `CloudView(first, points.size(), layout)` contains them.
void write(const std::vector<Point>& points, std::byte* first, const CloudLayout& layout) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::byte* const record = first + static_cast<std::ptrdiff_t>(i) * layout.stride;
    std::memcpy(record + layout.x, &points[i].x, sizeof(float));
    std::memcpy(record + layout.y, &points[i].y, sizeof(float));
    std::memcpy(record + layout.z, &points[i].z, sizeof(float));
  }
}

/// The sizes give full vectors, partial vectors, and more than one chunk.
class Layouts : public testing::TestWithParam<tests::MethodOnTarget> {
 protected:
  /// Writes the points, starting at `first`, and expects the result of the packed points.
  void expect_same_as_packed(const std::vector<Point>& points, std::byte* first,
                             const CloudLayout& layout) {
    write(points, first, layout);
    const tests::Outcome expected = tests::segmented(*packed_, view_of(points));
    EXPECT_TRUE(tests::is_same(expected,
                               tests::segmented(*other_, CloudView(first, points.size(), layout))))
        << points.size() << " points, stride " << layout.stride << ", x at " << layout.x;
  }

  /// Point 0 begins at `first` of `bytes` bytes. All bytes except the coordinates are 0xA5.
  void expect_same_as_packed(std::size_t bytes, std::size_t first, const CloudLayout& layout,
                             const std::vector<Point>& points) {
    std::vector<std::byte> memory(bytes, std::byte{0xA5});
    expect_same_as_packed(points, memory.data() + first, layout);
  }

  /// Tests the layout at several sizes, in consecutive records.
  void expect_same_as_packed(const CloudLayout& layout, std::size_t first = 0) {
    for (const std::size_t size : {1U, 15U, 16U, 17U, 33U, 1000U, 8192U, 8193U, 20000U}) {
      expect_same_as_packed(first + size * static_cast<std::size_t>(layout.stride) + 16, first,
                            layout, corrupted_cloud(size, 3));
    }
  }

 private:
  static std::unique_ptr<Segmenter> make() {
    if (std::get<0>(GetParam()) == "Surface") return std::make_unique<Surface>();
    return std::make_unique<Patchwork>();
  }

  tests::ForcedTarget forced_{std::get<1>(GetParam())};
  std::unique_ptr<Segmenter> packed_ = make();
  std::unique_ptr<Segmenter> other_ = make();
};

INSTANTIATE_TEST_SUITE_P(On, Layouts, tests::methods_on_targets(), tests::name_of);

TEST_P(Layouts, PackedXyz) { expect_same_as_packed({.stride = 12, .x = 0, .y = 4, .z = 8}); }

TEST_P(Layouts, PackedXyzi) { expect_same_as_packed({.stride = 16, .x = 0, .y = 4, .z = 8}); }

TEST_P(Layouts, IntensityFirst) { expect_same_as_packed({.stride = 16, .x = 4, .y = 8, .z = 12}); }

TEST_P(Layouts, FiveFloats) { expect_same_as_packed({.stride = 20, .x = 0, .y = 4, .z = 8}); }

TEST_P(Layouts, StructsOf32Bytes) { expect_same_as_packed({.stride = 32, .x = 0, .y = 4, .z = 8}); }

TEST_P(Layouts, StructsOfOddSize) { expect_same_as_packed({.stride = 13, .x = 1, .y = 5, .z = 9}); }

TEST_P(Layouts, MisalignedByOneByte) {
  expect_same_as_packed({.stride = 12, .x = 0, .y = 4, .z = 8}, 1);
  expect_same_as_packed({.stride = 16, .x = 0, .y = 4, .z = 8}, 1);
  expect_same_as_packed({.stride = 16, .x = 1, .y = 5, .z = 9});
}

TEST_P(Layouts, CoordinatesInADifferentOrder) {
  for (const std::ptrdiff_t stride : {12, 16}) {
    expect_same_as_packed({.stride = stride, .x = 8, .y = 4, .z = 0});
    expect_same_as_packed({.stride = stride, .x = 4, .y = 0, .z = 8});
    expect_same_as_packed({.stride = stride, .x = 0, .y = 8, .z = 4});
  }
}

TEST_P(Layouts, SeparateCoordinatesInARecordOf16Bytes) {
  expect_same_as_packed({.stride = 16, .x = 0, .y = 4, .z = 12});
  expect_same_as_packed({.stride = 16, .x = 0, .y = 8, .z = 12});
}

TEST_P(Layouts, Planar) {
  for (const std::size_t size : {1U, 16U, 33U, 8193U, 20000U}) {
    const auto plane = static_cast<std::ptrdiff_t>(4 * size);
    expect_same_as_packed(12 * size, 0, {.stride = 4, .x = 0, .y = plane, .z = 2 * plane},
                          corrupted_cloud(size, 3));
  }
}

TEST_P(Layouts, BackwardsThroughMemory) {
  for (const std::ptrdiff_t stride : {12, 16, 20}) {
    for (const std::size_t size : {1U, 16U, 33U, 8193U, 20000U}) {
      const std::size_t bytes = size * static_cast<std::size_t>(stride);
      expect_same_as_packed(bytes, bytes - static_cast<std::size_t>(stride),
                            {.stride = -stride, .x = 0, .y = 4, .z = 8}, corrupted_cloud(size, 3));
    }
  }
}

TEST_P(Layouts, AllPointsInOneRecord) {
  const std::vector<Point> points(500, Point{6.1f, 2.3f, -1.7f});
  expect_same_as_packed(12, 0, {.stride = 0, .x = 0, .y = 4, .z = 8}, points);
}

TEST_P(Layouts, OffsetsBeforeTheRecord) {
  for (const std::ptrdiff_t stride : {12, 16}) {
    expect_same_as_packed(static_cast<std::size_t>(1000 * stride) + 16, 16,
                          {.stride = stride, .x = -12, .y = -8, .z = -4}, corrupted_cloud(1000, 3));
  }
}

TEST_P(Layouts, NothingIsReadAfterTheLastCoordinate) {
  const tests::GuardedMemory memory(std::size_t{16448} * 20);
  const std::vector<Point> points = corrupted_cloud(16448, 6);
  for (const CloudLayout& layout : {CloudLayout{.stride = 12, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 0, .y = 4, .z = 8},
                                    CloudLayout{.stride = 16, .x = 4, .y = 8, .z = 12},
                                    CloudLayout{.stride = 20, .x = 0, .y = 4, .z = 8}}) {
    const auto expect_same_at_the_end = [&](std::size_t size) {
      // The memory ends after the last z, although the record has 16 or 20 bytes.
      const std::size_t bytes = (size - 1) * static_cast<std::size_t>(layout.stride) +
                                static_cast<std::size_t>(layout.z) + sizeof(float);
      expect_same_as_packed({points.begin(), points.begin() + static_cast<std::ptrdiff_t>(size)},
                            memory.last(bytes).data(), layout);
    };
    for (std::size_t size = 1; size <= 80; ++size) expect_same_at_the_end(size);
    for (std::size_t size = 8190; size <= 8210; ++size) expect_same_at_the_end(size);
    expect_same_at_the_end(points.size());
  }
}

TEST_P(Layouts, NothingIsReadBeforeTheFirstCoordinate) {
  const tests::GuardedMemory memory(std::size_t{20} * 100);
  for (const std::ptrdiff_t stride : {12, 16, 20}) {
    for (std::size_t size = 1; size <= 80; ++size) {
      // Point 0 is the last in memory, and x is the first number of its record.
      std::byte* const first =
          memory.first(1).data() + (size - 1) * static_cast<std::size_t>(stride);
      expect_same_as_packed(corrupted_cloud(size, 6), first,
                            {.stride = -stride, .x = 0, .y = 4, .z = 8});
    }
  }
}

}  // namespace
}  // namespace flagstone

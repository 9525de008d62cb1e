// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/read_baseline.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "library/core/simd_target.hpp"
#include "random_cloud.hpp"

namespace flagstone::bench {
namespace {

/// 1 if z is above x and y, point by point.
std::vector<std::uint8_t> expected_bytes(CloudView cloud) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    bytes.push_back(p.z > p.x && p.z > p.y ? 1 : 0);
  }
  return bytes;
}

/// Points in rows of `floats` floats. Any coordinate can be the largest, or NaN.
std::vector<float> rows_of(std::size_t points, std::size_t floats) {
  std::vector<float> rows(points * floats, -1000);
  const std::vector<Point> cloud = tests::corrupted_cloud(points, 7);
  for (std::size_t i = 0; i < points; ++i) {
    rows[i * floats] = cloud[i].y;
    rows[i * floats + 1] = cloud[i].z;
    rows[i * floats + 2] = cloud[i].x;
  }
  return rows;
}

/// Memory that ends directly before an inaccessible page.
class GuardedMemory {
 public:
  explicit GuardedMemory(std::size_t size) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t whole = (size + page - 1) / page * page;
    size_ = whole + page;
    base_ = static_cast<std::byte*>(
        ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    ::mprotect(base_ + whole, page, PROT_NONE);
    start_ = base_ + whole - size;
  }
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;
  GuardedMemory(GuardedMemory&&) = delete;
  GuardedMemory& operator=(GuardedMemory&&) = delete;
  ~GuardedMemory() { ::munmap(base_, size_); }

  [[nodiscard]] std::byte* start() const { return start_; }

 private:
  std::byte* base_;
  std::byte* start_;
  std::size_t size_;
};

class ReadBaseline : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_simd_target(GetParam()); }
  void TearDown() override { use_simd_target(""); }
};

INSTANTIATE_TEST_SUITE_P(Targets, ReadBaseline, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(ReadBaseline, MarksPointsHigherThanTheirXAndYInAnyLayout) {
  for (const std::size_t floats : {3U, 4U, 5U}) {
    const std::vector<float> rows = rows_of(3001, floats);
    const CloudView cloud(rows.data(), 3001, floats);
    std::vector<std::uint8_t> bytes(cloud.size(), 7);

    read_baseline(cloud, bytes);

    EXPECT_EQ(bytes, expected_bytes(cloud)) << floats << " floats per point";
    EXPECT_EQ(std::set(bytes.begin(), bytes.end()), (std::set<std::uint8_t>{0, 1}));
  }
}

TEST_P(ReadBaseline, ReadsPlanarStorage) {
  const std::vector<float> values = rows_of(100, 3);
  const CloudView cloud(values.data(), 100, {.stride = 4, .x = 0, .y = 400, .z = 800});
  std::vector<std::uint8_t> bytes(100, 7);

  read_baseline(cloud, bytes);

  EXPECT_EQ(bytes, expected_bytes(cloud));
}

TEST_P(ReadBaseline, ReadsAndWritesNothingPastTheEndForAnyNumberOfPoints) {
  for (const std::size_t floats : {3U, 4U}) {
    for (std::size_t points = 0; points < 70; ++points) {
      // The last row ends with z; a fourth float would lie in the inaccessible page.
      const std::vector<float> rows = rows_of(points, floats);
      const std::size_t size = points == 0 ? 0 : ((points - 1) * floats + 3) * sizeof(float);
      const GuardedMemory input(size);
      const GuardedMemory output(points);
      if (size > 0) std::memcpy(input.start(), rows.data(), size);
      const CloudView cloud(reinterpret_cast<const float*>(input.start()), points, floats);
      const std::span bytes(reinterpret_cast<std::uint8_t*>(output.start()), points);

      read_baseline(cloud, bytes);

      EXPECT_EQ(std::vector(bytes.begin(), bytes.end()), expected_bytes(cloud)) << points;
    }
  }
}

}  // namespace
}  // namespace flagstone::bench

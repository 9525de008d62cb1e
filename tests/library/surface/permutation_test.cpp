// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The result of `surface` does not depend on the order of the points: labels and heights of every
// point, patches and grids are bit-identical for each permutation. The environment variable
// FLAGSTONE_SHUFFLES sets the number of random permutations per cloud (default: 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/surface.hpp"
#include "numbers.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::Outcome;
using tests::random_cloud;
using tests::view_of;

/// `order[i]` is the index of the point that becomes point i.
using Order = std::vector<std::size_t>;

std::size_t shuffle_count() {
  const char* const text =
      std::getenv("FLAGSTONE_SHUFFLES");  // NOLINT(concurrency-mt-unsafe): one thread
  return text == nullptr ? 3 : std::stoul(text);
}

template <class T>
std::vector<T> reordered(const std::vector<T>& values, const Order& order) {
  std::vector<T> moved;
  for (const std::size_t i : order) moved.push_back(values[i]);
  return moved;
}

/// Inverse of reordered().
template <class T>
std::vector<T> restored(const std::vector<T>& moved, const Order& order) {
  std::vector<T> values(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) values[order[i]] = moved[i];
  return values;
}

/// Backwards, by height, column by column of the cells, and random permutations.
std::vector<Order> orders_of(const std::vector<Point>& cloud) {
  Order original(cloud.size());
  std::iota(original.begin(), original.end(), std::size_t{0});
  const auto sorted_by = [&](const std::function<float(Point)>& key) {
    Order order = original;
    const auto number = [&](std::size_t i) {
      const float value = key(cloud[i]);
      return std::isnan(value) ? -inf : value;
    };
    std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(number(i), i); });
    return order;
  };
  std::vector<Order> orders = {
      {original.rbegin(), original.rend()},
      sorted_by([](Point p) { return p.z; }),
      sorted_by([](Point p) { return std::floor(p.y * 4); }),
  };
  std::mt19937 random(1);
  for (std::size_t i = 0; i < shuffle_count(); ++i) {
    Order order = original;
    std::ranges::shuffle(order, random);
    orders.push_back(order);
  }
  return orders;
}

/// Expects the result of `cloud` for each permutation of it, in one thread and in two.
void expect_same_in_any_order(const std::vector<Point>& cloud, const std::string& what,
                              const SurfaceConfig& config = {}) {
  Surface alone(config);
  Surface in_two_threads(config, 2);
  const Outcome expected = tests::segmented(alone, view_of(cloud));
  std::size_t number = 0;
  for (const Order& order : orders_of(cloud)) {
    Surface& segmenter = ++number % 2 == 0 ? in_two_threads : alone;
    Outcome found = tests::segmented(segmenter, view_of(reordered(cloud, order)));
    found.labels = restored(found.labels, order);
    found.heights = restored(found.heights, order);
    ASSERT_TRUE(tests::is_same(expected, found)) << what << ", permutation " << number;
  }
}

/// Uniform numbers from `low` to `high`.
class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) : random_(seed) {}
  float operator()(float low, float high) {
    return low + (high - low) * static_cast<float>(random_() >> 8U) / 16777216.0f;
  }

 private:
  std::mt19937 random_;
};

/// Moves all coordinates to multiples of `step`.
std::vector<Point> on_a_lattice(std::vector<Point> cloud, float step) {
  for (Point& p : cloud) {
    for (float* const value : {&p.x, &p.y, &p.z}) *value = std::round(*value / step) * step;
  }
  return cloud;
}

/// Every point 1 to 5 times.
std::vector<Point> with_duplicates(const std::vector<Point>& cloud) {
  std::vector<Point> repeated;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    repeated.insert(repeated.end(), i % 5 + 1, cloud[i]);
  return repeated;
}

/// Points in a cube of side `size` metres on the ground at (x, y).
std::vector<Point> cube(std::size_t points, float x, float y, float size) {
  Uniform uniform(static_cast<std::uint32_t>(points));
  std::vector<Point> cloud(points);
  for (Point& p : cloud) {
    p = {x + uniform(0, size), y + uniform(0, size), -1.9f + uniform(0, size)};
  }
  return cloud;
}

TEST(SurfacePermutation, OfRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  for (const tests::RealScan& scan : scans) {
    io::Cloud file;
    const Status status = io::read_cloud(scan.points, {}, file);
    ASSERT_TRUE(status.ok()) << status.message();
    std::vector<Point> cloud;
    for (std::size_t i = 0; i < file.size(); ++i) cloud.push_back(file.view()[i]);
    expect_same_in_any_order(cloud, scan.set + "/" + scan.name,
                             {.sensor_height = scan.sensor_height});
  }
}

TEST(SurfacePermutation, OfRandomClouds) {
  for (const std::size_t size : {1U, 2U, 3U, 10U, 31U, 100U, 333U, 1000U, 8192U, 30000U}) {
    expect_same_in_any_order(random_cloud(size, 1), std::to_string(size) + " points");
  }
}

TEST(SurfacePermutation, OfTheFirstPointsOfAScan) {
  for (std::size_t size = 1; size <= 1000; size += 1 + size / 4) {
    std::vector<Point> cloud = random_cloud(44800, static_cast<std::uint32_t>(size));
    cloud.resize(size);
    expect_same_in_any_order(cloud, std::to_string(size) + " points");
  }
}

TEST(SurfacePermutation, OfCorruptedClouds) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    expect_same_in_any_order(corrupted_cloud(12000, seed), "corrupted " + std::to_string(seed));
  }
}

TEST(SurfacePermutation, OfDuplicatePoints) {
  expect_same_in_any_order(with_duplicates(random_cloud(6000, 3)), "duplicates");
  expect_same_in_any_order(std::vector<Point>(500, Point{6.1f, 2.3f, -1.7f}), "all equal");
}

TEST(SurfacePermutation, OfPointsOnALattice) {
  // Points on boundaries of cells, and points on positions where fixed-point coordinates round.
  for (const float step :
       {1.0f / 1024, 1.0f / 512, 1.0f / 256, 1.0f / 128, 1.0f / 16, 0.25f, 0.5f, 2.0f}) {
    const std::vector<Point> cloud = on_a_lattice(random_cloud(15000, 4), step);
    expect_same_in_any_order(cloud, "multiples of " + std::to_string(step));
  }
}

TEST(SurfacePermutation, OfPointsThatDifferByLessThanAMillimetre) {
  for (const float step : {1.0f / 512, 1.0f / 128, 0.25f}) {
    std::vector<Point> cloud = with_duplicates(on_a_lattice(random_cloud(5000, 5), step));
    Uniform uniform(5);
    for (Point& p : cloud) {
      for (float* const value : {&p.x, &p.y, &p.z}) *value += uniform(-5e-4f, 5e-4f);
    }
    expect_same_in_any_order(cloud, "nearly multiples of " + std::to_string(step));
  }
}

TEST(SurfacePermutation, OfOneCellWithManyPoints) {
  for (const std::size_t size :
       {1U, 2U, 3U, 4U, 31U, 32U, 33U, 127U, 128U, 129U, 500U, 1000U, 20000U}) {
    for (const float side : {0.25f, 2.0f}) {
      const std::string what = std::to_string(size) + " points in " + std::to_string(side) + " m";
      std::vector<Point> cloud = cube(size, 6, 2, side);
      expect_same_in_any_order(cloud, what);
      const std::vector<Point> around = random_cloud(5000, 6);
      cloud.insert(cloud.end(), around.begin(), around.end());
      expect_same_in_any_order(cloud, what + " of a scan");
    }
  }
}

TEST(SurfacePermutation, WithUnusualSettings) {
  const std::vector<Point> cloud = random_cloud(15000, 7);
  for (const int levels : {0, 1, 3}) {
    SurfaceConfig config;
    config.refinement.levels = levels;
    expect_same_in_any_order(cloud, std::to_string(levels) + " levels", config);
  }
  for (const float range : {8.0f, 30.0f, 200.0f}) {
    expect_same_in_any_order(cloud, "up to " + std::to_string(range) + " m", {.max_range = range});
  }
}

}  // namespace
}  // namespace flagstone

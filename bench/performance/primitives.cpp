// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Each step of Patchwork and of surface by itself on one simulated scan, for every instruction set
// that this machine has. Options are Google Benchmark's: --benchmark_filter=gather,
// --benchmark_format=json.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <flagstone/patchwork.hpp>
#include <flagstone/segmentation.hpp>
#include <flagstone/segmenter.hpp>
#include <flagstone/surface.hpp>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clouds.hpp"
#include "library/core/plane.hpp"
#include "library/core/simd_target.hpp"
#include "library/patchwork/bin_labels.hpp"
#include "library/patchwork/concentric_zones.hpp"
#include "library/patchwork/read_scan.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/plane_fits/ground_sets.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/plane_fits/seed_heights.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/square_cells.hpp"
#include "surface_steps.hpp"

namespace flagstone::performance {
namespace {

using namespace flagstone::plane_fits;  // NOLINT(google-build-using-namespace): what is measured
using namespace flagstone::patchwork;   // NOLINT(google-build-using-namespace): the same

/// A scan after every step, so that each can be done again.
class Steps {
 public:
  explicit Steps(Cloud points) : cloud(std::move(points)), zones(config), labels(cloud.size()) {
    scan.reserve(cloud.size());
    groups.reserve(cloud.size(), zones.group_count());
    read(view_of(cloud));
    group();
    fill_batches();
    heights.reserve(cloud.size());
    bin_labels.reserve(cloud.size());
    moments.resize(batches.size());
    sum(Precision::full);
  }

  void read(CloudView view) {
    for (std::size_t chunk = 0; chunk < ScanPoints::chunk_count(view.size()); ++chunk) {
      read_chunk(view, chunk, zones, scan);
    }
  }

  void group() { groups.group(scan, cloud.size(), zones.group_count()); }

  void gather() {
    for (BinBatch& batch : batches) batch.gather(scan, groups);
  }

  void find_seeds() {
    std::array<float, batch_size> floors{};
    floors.fill(-1.1f * config.sensor_height);
    std::array<std::uint32_t, batch_size> counts{};
    counts.fill(static_cast<std::uint32_t>(config.seed_count));
    Batch means;
    for (const BinBatch& batch : batches) {
      heights.find(batch, floors, counts, means);
      benchmark::DoNotOptimize(means);
    }
  }

  void sum(Precision precision) {
    constexpr BinMask all = (1U << batch_size) - 1;
    GroundSets sets;
    sets.fill(ground);
    for (std::size_t i = 0; i < batches.size(); ++i) {
      sum_moments(batches[i], sets, all, precision, moments[i]);
    }
  }

  void fit() {
    PlaneBatch planes;
    for (const MomentsBatch& batch : moments) {
      benchmark::DoNotOptimize(fit_planes(batch, planes));
      benchmark::DoNotOptimize(planes);
    }
  }

  void write_labels() {
    for (const BinBatch& batch : batches) {
      for (std::size_t i = 0; i < batch.count(); ++i) {
        benchmark::DoNotOptimize(bin_labels.write(batch, i, ground, true, groups, labels));
      }
    }
  }

  PatchworkConfig config;
  Cloud cloud;
  ConcentricZones zones;
  ScanPoints scan;
  BinGroups groups;
  std::vector<BinBatch> batches;
  std::size_t points_in_batches = 0;

 private:
  void fill_batches() {
    for (std::uint32_t bin = 0; bin < zones.bin_count(); ++bin) {
      const std::uint32_t size = groups.size(bin);
      if (size < static_cast<std::uint32_t>(config.min_points)) continue;
      if (batches.empty() || batches.back().count() == batch_size) {
        batches.emplace_back().clear();
      }
      batches.back().add(bin, size);
      points_in_batches += size;
    }
    for (BinBatch& batch : batches) {
      std::size_t points = 0;
      for (std::size_t i = 0; i < batch.count(); ++i) points += batch.size(i);
      batch.reserve(points);
    }
    gather();
  }

  /// Points lower than 30 cm above a ground that is as far below the sensor as it should be.
  static constexpr GroundSet ground{.normal_x = 0,
                                    .normal_y = 0,
                                    .normal_z = 1,
                                    .bottom = -std::numeric_limits<float>::infinity(),
                                    .top = -1.43f};
  SeedHeights heights;
  BinLabels bin_labels;
  std::vector<Label> labels;
  std::vector<MomentsBatch> moments;
};

/// `work` on every instruction set, with `items` each time it is done.
void add(const std::string& name, std::size_t items, const std::function<void()>& work) {
  for (const std::string& target : simd_targets()) {
    const std::string title = std::string(name).append("/").append(target);
    benchmark::RegisterBenchmark(title.c_str(), [=](benchmark::State& state) {
      use_simd_target(target);
      for (auto _ : state) {
        work();
        benchmark::ClobberMemory();
      }
      state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(items));
      use_simd_target("");
    })->Unit(benchmark::kMicrosecond);
  }
}

void add_all(Steps& ordered, Steps& scattered, const std::vector<float>& xyzi) {
  const std::size_t points = ordered.cloud.size();
  const CloudView with_intensity(xyzi.data(), points, 4);
  // The points read are the same, so that the later steps of `ordered` are not disturbed.
  add("read_xyz", points, [&] { ordered.read(view_of(ordered.cloud)); });
  add("read_xyzi", points, [&ordered, with_intensity] { ordered.read(with_intensity); });
  add("group", points, [&] { ordered.group(); });
  add("group_shuffled", points, [&] { scattered.group(); });
  add("gather", ordered.points_in_batches, [&] { ordered.gather(); });
  add("gather_shuffled", scattered.points_in_batches, [&] { scattered.gather(); });
  add("seed_heights", ordered.points_in_batches, [&] { ordered.find_seeds(); });
  add("sum_moments_single", ordered.points_in_batches, [&] { ordered.sum(Precision::single); });
  add("sum_moments_full", ordered.points_in_batches, [&] { ordered.sum(Precision::full); });
  add("fit_planes", ordered.batches.size() * batch_size, [&] { ordered.fit(); });
  add("write_labels", ordered.points_in_batches, [&] { ordered.write_labels(); });
  add("write_labels_shuffled", scattered.points_in_batches, [&] { scattered.write_labels(); });
}

void add_all_of_surface(SurfaceSteps& ordered, SurfaceSteps& scattered) {
  const std::size_t points = ordered.cloud.size();
  add("surface_read_xyz", points, [&] { ordered.read(); });
  add("surface_group", points, [&] { ordered.group(); });
  add("surface_group_shuffled", points, [&] { scattered.group(); });
  add("surface_sample", ordered.sampled_points(), [&] { ordered.sample(); });
  for (std::size_t level = 0; level < surface::level_count; ++level) {
    add(fmt::format("surface_observe_{}m", surface::levels[level].cell),
        ordered.occupied_cells(level), [&ordered, level] { ordered.observe(level); });
  }
  add("surface_fill", ordered.filled_cells(), [&] { ordered.fill(); });
  add("surface_refine", points, [&] { ordered.refine(); });
  add("surface_measure", points, [&] { ordered.measure(); });
  add("surface_measure_shuffled", points, [&] { scattered.measure(); });
  add("surface_label", points, [&] { ordered.label(); });
}

/// Whole methods, for comparison with the sums of their steps.
void add_whole(const std::string& name, Segmenter& segmenter, const Cloud& cloud) {
  add(name, cloud.size(), [&segmenter, &cloud, result = std::make_shared<Segmentation>()] {
    benchmark::DoNotOptimize(segmenter.segment(view_of(cloud), *result));
  });
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  using namespace flagstone::performance;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const Cloud street = simulated_street(64, 2600, 1);
  flagstone::Random random(1);
  Steps ordered(street);
  Steps scattered(shuffled(street, random));
  std::vector<float> xyzi;
  for (const flagstone::Point& p : street) xyzi.insert(xyzi.end(), {p.x, p.y, p.z, 0.0f});
  benchmark::AddCustomContext("points", std::to_string(street.size()));
  add_all(ordered, scattered, xyzi);
  SurfaceSteps surface_ordered(street);
  SurfaceSteps surface_scattered(scattered.cloud);
  add_all_of_surface(surface_ordered, surface_scattered);
  flagstone::Patchwork patchwork;
  flagstone::Surface surface;
  add_whole("patchwork", patchwork, ordered.cloud);
  add_whole("patchwork_shuffled", patchwork, scattered.cloud);
  add_whole("surface", surface, ordered.cloud);
  add_whole("surface_shuffled", surface, scattered.cloud);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

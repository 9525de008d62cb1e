// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures how time and memory of Patchwork or surface scale with points, beams, bins and threads
// on simulated streets. Prints JSON. bench/scaling.py runs this program and draws the plot.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <flagstone/patchwork_config.hpp>
#include <flagstone/segmentation.hpp>
#include <flagstone/segmenter.hpp>
#include <flagstone/surface_config.hpp>
#include <flagstone/version.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "clouds.hpp"
#include "lab/bench/allocation_count.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/eval/results_export.hpp"
#include "library/core/simd_target.hpp"
#include "terminal.hpp"
#include "timing.hpp"

namespace flagstone::performance {
namespace {

using Json = nlohmann::ordered_json;
using Config = bench::TimedConfig;

constexpr std::size_t usual_size = 120000;  ///< about the points of an HDL-64E scan

/// A segmenter and its result, reused for all scans.
struct Worker {
  explicit Worker(const Config& config, unsigned threads = 1)
      : segmenter(bench::make_timed(config, {}, threads, nullptr)) {}

  void operator()(CloudView cloud) {
    const Status status = segmenter->segment(cloud, result);
    if (!status.ok()) throw std::runtime_error(status.message());
  }

  std::unique_ptr<Segmenter> segmenter;
  Segmentation result;
};

Duration time_of_scan(Worker& worker, CloudView cloud, double budget = 250) {
  return time_of([&] { worker(cloud); }, budget);
}

Json to_json(const Duration& duration) {
  return {{"median_ms", duration.median}, {"least_ms", duration.minimum}};
}

/// Time and memory for clouds of different sizes, in sensor order and shuffled.
Json scaling_with_points(const Config& config, const Cloud& dense, std::size_t max_points) {
  Json rows = Json::array();
  Random random(1);
  constexpr std::array<std::size_t, 9> sizes = {1000,   3000,    10000,   30000,   100000,
                                                300000, 1000000, 3000000, 10000000};
  for (const std::size_t size : sizes) {
    if (size > max_points) break;
    show_progress("points: " + std::to_string(size));
    Cloud cloud = resized(dense, size);
    const std::size_t before = bench::allocation_count().bytes;
    Worker worker(config);
    const Duration ordered = time_of_scan(worker, view_of(cloud));
    const std::size_t held = bench::allocation_count().bytes - before;
    cloud = shuffled(std::move(cloud), random);
    const Duration shuffled_time = time_of_scan(worker, view_of(cloud));
    rows.push_back({{"points", size},
                    {"ordered", to_json(ordered)},
                    {"shuffled", to_json(shuffled_time)},
                    {"bytes_held", held},
                    {"bytes_held_after_shuffled", bench::allocation_count().bytes - before}});
  }
  return rows;
}

/// Time by number of beams, with 2,048 columns.
Json scaling_with_beams(const Config& config) {
  Json rows = Json::array();
  for (const int beams : {16, 32, 64, 128}) {
    show_progress("beams: " + std::to_string(beams));
    const Cloud cloud = simulated_street(beams, 2048, 1);
    Worker worker(config);
    rows.push_back({{"beams", beams},
                    {"points", cloud.size()},
                    {"time", to_json(time_of_scan(worker, view_of(cloud)))}});
  }
  return rows;
}

/// One zone with `rings` rings of equal width and `sectors` sectors.
PatchworkConfig layout_of(int rings, int sectors) {
  PatchworkConfig config;
  const float outer = config.zones.back().ring_radii.back();
  config.zones = {{.ring_radii = equal_rings(config.min_range, outer, rings), .sectors = sectors}};
  return config;
}

Json time_of_layout(const std::string& name, const PatchworkConfig& config, const Cloud& cloud) {
  show_progress("bins: " + name);
  std::size_t rings = 0;
  std::size_t bins = 0;
  for (const Zone& zone : config.zones) {
    rings += zone.ring_radii.size();
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  const std::size_t before = bench::allocation_count().bytes;
  Worker worker(config);
  const Duration time = time_of_scan(worker, view_of(cloud));
  return {{"layout", name},        {"rings", rings},
          {"bins", bins},          {"patches", worker.result.patches().size()},
          {"time", to_json(time)}, {"bytes_held", bench::allocation_count().bytes - before}};
}

Json scaling_with_bins(const Cloud& cloud) {
  Json rows = Json::array();
  constexpr std::array<std::pair<int, int>, 6> layouts = {
      {{4, 25}, {6, 50}, {10, 100}, {20, 150}, {40, 250}, {50, 400}}};
  for (const auto& [rings, sectors] : layouts) {
    rows.push_back(time_of_layout(std::to_string(rings) + " x " + std::to_string(sectors),
                                  layout_of(rings, sectors), cloud));
  }
  return rows;
}

/// Time and memory by range of the cells of surface and by number of refinement levels.
Json scaling_with_cells(const Cloud& cloud) {
  Json rows = Json::array();
  const auto add_row = [&](const SurfaceConfig& config) {
    show_progress("cells");
    const std::size_t before = bench::allocation_count().bytes;
    Worker worker(config);
    const Duration time = time_of_scan(worker, view_of(cloud));
    rows.push_back({{"max_range", config.max_range},
                    {"levels", config.refinement.levels},
                    {"time", to_json(time)},
                    {"bytes_held", bench::allocation_count().bytes - before}});
  };
  for (const float max_range : {25.0f, 50.0f, 100.0f, 200.0f}) add_row({.max_range = max_range});
  for (const int levels : {0, 1, 2, 3}) add_row({.refinement = {.levels = levels}});
  return rows;
}

/// Zones whose rings do not fit in vector registers, with about as many bins as the default.
Json general_layouts(const Cloud& cloud) {
  Json rows = Json::array();
  rows.push_back(time_of_layout("default", PatchworkConfig{}, cloud));
  constexpr std::array<std::pair<int, int>, 4> layouts = {{{16, 34}, {17, 32}, {34, 16}, {68, 8}}};
  for (const auto& [rings, sectors] : layouts) {
    rows.push_back(time_of_layout(std::to_string(rings) + " x " + std::to_string(sectors),
                                  layout_of(rings, sectors), cloud));
  }
  return rows;
}

/// Time by memory layout of the points.
Json memory_layouts(const Config& config, const Cloud& cloud) {
  struct Layout {
    const char* name;
    CloudLayout layout;
  };
  const auto plane = static_cast<std::ptrdiff_t>(cloud.size() * sizeof(float));
  const std::array<Layout, 6> layouts = {
      {{"xyz, 12 bytes", {12, 0, 4, 8}},
       {"xyzi, 16 bytes", {16, 0, 4, 8}},
       {"18 bytes, unaligned", {18, 0, 4, 8}},
       {"20 bytes", {20, 0, 4, 8}},
       {"32 bytes", {32, 0, 4, 8}},
       {"x, y, z in separate arrays", {4, 0, plane, 2 * plane}}}};
  Json rows = Json::array();
  for (const auto& [name, layout] : layouts) {
    show_progress(std::string("memory: ") + name);
    const auto record = static_cast<std::size_t>(std::max<std::ptrdiff_t>(layout.stride, 12));
    std::vector<char> bytes(cloud.size() * record);
    const auto put = [&](std::size_t point, std::ptrdiff_t offset, float value) {
      const auto at = static_cast<std::ptrdiff_t>(point) * layout.stride + offset;
      std::memcpy(bytes.data() + at, &value, sizeof value);
    };
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      put(i, layout.x, cloud[i].x);
      put(i, layout.y, cloud[i].y);
      put(i, layout.z, cloud[i].z);
    }
    Worker worker(config);
    const Duration time = time_of_scan(worker, CloudView(bytes.data(), cloud.size(), layout));
    rows.push_back({{"memory", name}, {"time", to_json(time)}});
  }
  return rows;
}

bool has_identical_labels(const Segmentation& a, const Segmentation& b) {
  return std::ranges::equal(a.labels(), b.labels());
}

/// Time of one scan by number of threads.
Json scaling_with_threads_of_one_scan(const Config& config, const Cloud& dense, unsigned cores) {
  Json rows = Json::array();
  for (const std::size_t size : {usual_size, std::size_t{1000000}}) {
    const Cloud cloud = resized(dense, size);
    Worker alone(config);
    alone(view_of(cloud));
    for (unsigned threads = 1; threads <= cores; ++threads) {
      show_progress("threads of one scan: " + std::to_string(threads));
      Worker worker(config, threads);
      const Duration time = time_of_scan(worker, view_of(cloud), 500);
      rows.push_back({{"points", size},
                      {"threads", threads},
                      {"time", to_json(time)},
                      {"same_labels", has_identical_labels(worker.result, alone.result)}});
    }
  }
  return rows;
}

/// Throughput for many scans in parallel. Every thread segments all scans.
Json scaling_with_threads_of_many_scans(const Config& config, const Cloud& dense, unsigned cores) {
  constexpr std::size_t scan_count = 8;
  constexpr std::size_t rounds = 40;
  std::vector<Cloud> clouds;
  std::vector<Segmentation> expected(scan_count);
  Worker alone(config);
  for (std::size_t scan = 0; scan < scan_count; ++scan) {
    clouds.push_back(rotated(resized(dense, usual_size), 0.7 * static_cast<double>(scan)));
    alone(view_of(clouds.back()));
    expected[scan] = alone.result;
  }
  Json rows = Json::array();
  for (unsigned threads = 1; threads <= cores; ++threads) {
    show_progress("threads of many scans: " + std::to_string(threads));
    std::vector<Worker> workers;
    workers.reserve(threads);
    for (unsigned t = 0; t < threads; ++t) workers.emplace_back(config);
    std::vector<char> same(threads, 1);
    const auto run_on_threads = [&](const auto& work) {
      std::vector<std::jthread> other_threads;
      for (unsigned t = 1; t < threads; ++t) other_threads.emplace_back([&work, t] { work(t); });
      work(0);
    };
    run_on_threads([&](unsigned t) {  // warm-up and comparison
      for (std::size_t scan = 0; scan < scan_count; ++scan) {
        workers[t](view_of(clouds[scan]));
        if (!has_identical_labels(workers[t].result, expected[scan])) same[t] = 0;
      }
    });
    Stopwatch stopwatch;
    run_on_threads([&](unsigned t) {
      for (std::size_t i = 0; i < rounds * scan_count; ++i) {
        workers[t](view_of(clouds[(i + t) % scan_count]));
      }
    });
    const double seconds = stopwatch.lap() / 1000;
    rows.push_back({{"threads", threads},
                    {"points", usual_size},
                    {"scans_per_second", threads * rounds * scan_count / seconds},
                    {"same_labels", std::ranges::all_of(same, [](char s) { return s != 0; })}});
  }
  return rows;
}

int run(const Config& config, std::size_t max_points) {
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  show_progress("simulating");
  // About two thirds of the firings return.
  const auto columns = static_cast<int>(std::max(max_points, std::size_t{1000000}) * 17 / 640);
  const Cloud dense = simulated_street(64, columns, 1);
  const Cloud cloud = resized(dense, usual_size);
  Json result = {{"flagstone", FLAGSTONE_VERSION},
                 {"date", eval::today()},
                 {"machine", eval::machine_name()},
                 {"simd", simd_target()},
                 {"simulated_points", dense.size()}};
  result["points"] = scaling_with_points(config, dense, max_points);
  result["beams"] = scaling_with_beams(config);
  if (std::holds_alternative<SurfaceConfig>(config)) {
    result["cells"] = scaling_with_cells(cloud);
  } else {
    result["bins"] = scaling_with_bins(cloud);
    result["general_layouts"] = general_layouts(cloud);
  }
  result["memory_layouts"] = memory_layouts(config, cloud);
  result["threads_of_one_scan"] = scaling_with_threads_of_one_scan(config, dense, cores);
  result["threads_of_many_scans"] = scaling_with_threads_of_many_scans(config, dense, cores);
  show_progress("");
  std::cout << result.dump(1) << '\n';
  return 0;
}

/// The number in `text`, or 0 if it is not a number up to 10,000,000.
std::size_t parse_points(std::string_view text) {
  std::size_t points = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || points > 10000000) return 0;
    points = 10 * points + static_cast<std::size_t>(c - '0');
  }
  return points;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  constexpr std::size_t all = 10000000;
  const std::string_view method = argc > 1 ? argv[1] : "";
  const std::size_t max_points = argc == 3 ? flagstone::performance::parse_points(argv[2]) : all;
  if (argc > 3 || (method != "patchwork" && method != "surface") || max_points < 1000 ||
      max_points > all) {
    std::fputs(
        "usage: scaling patchwork|surface [POINTS]\n"
        "POINTS: size of the largest cloud, 1000 to 10000000 (default: 10000000)\n",
        stderr);
    return 2;
  }
  try {
    using flagstone::performance::run;
    return method == "surface" ? run(flagstone::SurfaceConfig{}, max_points)
                               : run(flagstone::PatchworkConfig{}, max_points);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scaling: %s\n", error.what());
    return 1;
  }
}

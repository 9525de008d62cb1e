// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Measures the time of Patchwork and surface on 10,000 different scans, including adversarial
// scans, and lists scans that are slow for their size. Prints Markdown.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <flagstone/patchwork.hpp>
#include <flagstone/segmentation.hpp>
#include <flagstone/segmenter.hpp>
#include <flagstone/surface.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clouds.hpp"
#include "lab/eval/results_export.hpp"
#include "latency_scans.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"
#include "terminal.hpp"
#include "timing.hpp"

namespace flagstone::performance {
namespace {

/// The number of scans of one size; 10,000 in total.
struct SizeClass {
  std::size_t points;
  std::size_t scans;
};
constexpr std::array<SizeClass, 4> size_classes = {
    {{1000, 3600}, {10000, 3600}, {120000, 2640}, {1000000, 160}}};

/// Number of runs per scan. The fastest run is the cost of the input. The first run also includes
/// other programs and cold caches.
constexpr int repeats = 5;

/// Scans that take more than this multiple of the median of their kind are measured again at the
/// end, to exclude effects of other programs.
constexpr double suspicious = 1.2;

struct Times {
  std::vector<double> first;       ///< first run of each scan, milliseconds
  std::vector<double> best;        ///< fastest run of each scan, milliseconds
  std::vector<std::size_t> scans;  ///< numbers of the scans
};

/// Times by size class and kind.
using Table = std::vector<std::vector<Times>>;

std::unique_ptr<Segmenter> make(std::string_view method) {
  if (method == "surface") return std::make_unique<Surface>();
  return std::make_unique<Patchwork>();
}

/// Segments scans of one size.
class Bench {
 public:
  Bench(std::string_view method, const std::vector<ScanKind>& kinds, std::size_t points)
      : kinds_(kinds), points_(points), segmenter_(make(method)) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      (kinds[k].ordinary ? ordinary_ : others_).push_back(k);
    }
    Random random(points);
    for (const ScanKind& kind : kinds) {  // allocates the buffers
      (void)segmenter_->segment(view_of(kind.draw(points, random)), result_);
    }
  }

  /// The kind of a scan. Every other scan is ordinary.
  [[nodiscard]] std::size_t kind_of(std::size_t scan) const {
    const std::vector<std::size_t>& kinds = scan % 2 == 0 ? ordinary_ : others_;
    return kinds[scan / 2 % kinds.size()];
  }

  void measure(std::size_t scan, std::vector<Times>& times_of_kinds) {
    Times& times = times_of_kinds[kind_of(scan)];
    const Cloud cloud = draw(scan);
    times.scans.push_back(scan);
    times.first.push_back(time_of_one(cloud));
    times.best.push_back(times.first.back());
    for (int repeat = 1; repeat < repeats; ++repeat) {
      times.best.back() = std::min(times.best.back(), time_of_one(cloud));
    }
  }

  /// Measures suspicious scans again.
  void measure_again(Times& times) {
    const double limit = suspicious * quantile(times.best, 0.5);
    for (std::size_t i = 0; i < times.scans.size(); ++i) {
      if (times.best[i] <= limit) continue;
      const Cloud cloud = draw(times.scans[i]);
      for (int repeat = 0; repeat < 2 * repeats; ++repeat) {
        times.best[i] = std::min(times.best[i], time_of_one(cloud));
      }
    }
  }

 private:
  Cloud draw(std::size_t scan) {
    Random random = Random::stream(points_, scan);
    return kinds_[kind_of(scan)].draw(points_, random);
  }

  double time_of_one(const Cloud& cloud) {
    Stopwatch stopwatch;
    const Status status = segmenter_->segment(view_of(cloud), result_);
    const double time = stopwatch.lap();
    if (!status.ok()) throw std::runtime_error(status.message());
    return time;
  }

  const std::vector<ScanKind>& kinds_;
  std::size_t points_;
  std::vector<std::size_t> ordinary_;  ///< kinds
  std::vector<std::size_t> others_;
  std::unique_ptr<Segmenter> segmenter_;
  Segmentation result_;
};

Table measure(std::string_view method, const std::vector<ScanKind>& kinds) {
  Table table;
  std::size_t done = 0;
  for (const SizeClass& size_class : size_classes) {
    std::vector<Times>& times = table.emplace_back(kinds.size());
    Bench bench(method, kinds, size_class.points);
    for (std::size_t scan = 0; scan < size_class.scans; ++scan, ++done) {
      if (done % 100 == 0) show_progress(fmt::format("{}: {} of 10000 scans", method, done));
      bench.measure(scan, times);
    }
    for (Times& of_kind : times) bench.measure_again(of_kind);
  }
  show_progress("");
  return table;
}

Times all_of(const std::vector<Times>& kinds, const std::vector<ScanKind>& names,
             bool only_ordinary) {
  Times all;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (only_ordinary && !names[k].ordinary) continue;
    all.first.insert(all.first.end(), kinds[k].first.begin(), kinds[k].first.end());
    all.best.insert(all.best.end(), kinds[k].best.begin(), kinds[k].best.end());
  }
  return all;
}

/// | median | 99 % | 99.9 % | maximum | 99.9 % / median |
std::string cells(const std::vector<double>& times) {
  const double median = quantile(times, 0.5);
  const double high = quantile(times, 0.999);
  return fmt::format(" {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} |", median, quantile(times, 0.99),
                     high, quantile(times, 1), high / median);
}

void print_by_size(const Table& table, const std::vector<ScanKind>& kinds) {
  fmt::print(
      "| points, scans, time | median, ms | 99 % | 99.9 % | maximum | 99.9 % / median |\n"
      "|---|---:|---:|---:|---:|---:|\n");
  for (std::size_t s = 0; s < table.size(); ++s) {
    for (const bool ordinary : {true, false}) {
      const Times times = all_of(table[s], kinds, ordinary);
      const std::string title =
          fmt::format("| {}, {} {}", size_classes[s].points, times.first.size(),
                      ordinary ? "ordinary" : "of all kinds");
      fmt::print("{}, best of 5 |{}\n", title, cells(times.best));
      fmt::print("{}, first run |{}\n", title, cells(times.first));
    }
  }
}

void print_by_kind(const Table& table, const std::vector<ScanKind>& kinds) {
  constexpr std::size_t usual = 2;  // 120,000 points
  fmt::print(
      "\n| kind, {} points, best of {} | median, ms | 99 % | 99.9 % | maximum | 99.9 % / median "
      "| median / ordinary |\n|---|---:|---:|---:|---:|---:|---:|\n",
      size_classes[usual].points, repeats);
  const double ordinary = quantile(all_of(table[usual], kinds, true).best, 0.5);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::vector<double>& times = table[usual][k].best;
    fmt::print("| {} |{} {:.2f} |\n", kinds[k].name, cells(times), quantile(times, 0.5) / ordinary);
  }
}

/// Nanoseconds per n log2 n.
double cost(double milliseconds, std::size_t points) {
  const auto n = static_cast<double>(points);
  return milliseconds * 1e6 / (n * std::log2(n));
}

/// The last column is the ratio of the costs of the last and the second size. It exceeds 1 if the
/// time grows faster than n log n.
void print_scaling(const Table& table, const std::vector<ScanKind>& kinds) {
  fmt::print("\n| slowest scan, ns / (n log2 n) |");
  for (const SizeClass& size_class : size_classes) fmt::print(" {} |", size_class.points);
  fmt::print(" last / {} |\n|---|", size_classes[1].points);
  for (std::size_t column = 0; column <= size_classes.size(); ++column) fmt::print("---:|");
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    fmt::print("\n| {} |", kinds[k].name);
    std::vector<double> costs;
    for (std::size_t s = 0; s < table.size(); ++s) {
      costs.push_back(cost(quantile(table[s][k].best, 1), size_classes[s].points));
      fmt::print(" {:.3f} |", costs.back());
    }
    fmt::print(" {:.2f} |", costs.back() / costs[1]);
  }
  fmt::print("\n");
}

/// Kinds with a scan more than three times as slow as ordinary scans of its size.
void print_slow(const Table& table, const std::vector<ScanKind>& kinds) {
  fmt::print("\nScans that take more than 3 times the median of ordinary scans of their size:\n\n");
  bool any = false;
  for (std::size_t s = 0; s < table.size(); ++s) {
    const double ordinary = quantile(all_of(table[s], kinds, true).best, 0.5);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const double ratio = quantile(table[s][k].best, 1) / ordinary;
      if (ratio <= 3) continue;
      fmt::print("- {} points, {}: {:.2f}\n", size_classes[s].points, kinds[k].name, ratio);
      any = true;
    }
  }
  if (!any) fmt::print("none\n");
}

int run(const std::vector<std::string_view>& methods) {
  show_progress("simulating");
  const Sources sources = load_sources();
  const std::vector<ScanKind> kinds = scan_kinds(sources);
  std::size_t real_count = sources.voxel_means.size();
  for (const auto& [set, scans] : sources.real) real_count += scans.size();
  for (const std::string_view method : methods) {
    const Table table = measure(method, kinds);
    fmt::print("Method {}: {}, {}, {}; from {} simulated and {} real scans.\n\n", method,
               eval::today(), eval::machine_name(), simd_target(), sources.simulated.size(),
               real_count);
    print_by_size(table, kinds);
    print_by_kind(table, kinds);
    print_scaling(table, kinds);
    print_slow(table, kinds);
    fmt::print("\n");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace flagstone::performance

int main(int argc, char** argv) {
  std::vector<std::string_view> methods(argv + 1, argv + argc);
  for (const std::string_view method : methods) {
    if (method == "patchwork" || method == "surface") continue;
    std::fputs(
        "usage: latency [patchwork] [surface]\n"
        "Default: both. FLAGSTONE_DATA is the directory of real scans.\n",
        stderr);
    return 2;
  }
  if (methods.empty()) methods = {"patchwork", "surface"};
  try {
    return flagstone::performance::run(methods);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "latency: %s\n", error.what());
    return 1;
  }
}

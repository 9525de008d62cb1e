// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/benchmark.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "lab/bench/allocation_count.hpp"
#include "lab/bench/candidates.hpp"
#include "lab/bench/pinned_core.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::bench {

std::vector<std::size_t> order_of_round(std::size_t candidates, std::size_t round) {
  std::vector<std::size_t> order(candidates);
  for (std::size_t i = 0; i < candidates; ++i) {
    const std::size_t step = round % 2 == 0 ? i : candidates - i;
    // Two consecutive rounds, one in each direction, begin with the same candidate.
    order[i] = (round / 2 + step) % candidates;
  }
  return order;
}

void run_passes(Candidate& candidate, std::size_t scans,
                const std::function<void(std::size_t scan, const Trial&)>& note,
                const std::function<bool()>& stop) {
  const std::size_t untimed = candidate.untimed_passes();
  for (std::size_t pass = 0; pass <= untimed; ++pass) {
    for (std::size_t scan = 0; scan < scans && !stop(); ++scan) {
      const Trial trial = candidate.run_trial(scan);
      if (pass == untimed) note(scan, trial);
    }
  }
}

namespace {

constexpr double seconds_by_default = 10;
constexpr double fewest_rounds = 3;
constexpr double most_rounds = 10000;  // for very small scans

/// Selects an instruction set, and the best one again on destruction.
struct TargetReset {
  explicit TargetReset(const std::string& target) { use_simd_target(target); }
  TargetReset(const TargetReset&) = delete;
  TargetReset& operator=(const TargetReset&) = delete;
  TargetReset(TargetReset&&) = delete;
  TargetReset& operator=(TargetReset&&) = delete;
  ~TargetReset() { use_simd_target(""); }
};

/// A participant of the benchmark.
struct Entrant {
  std::unique_ptr<Candidate> candidate;  // null after a failure
  std::function<void(std::size_t round, std::size_t scan, const Trial&)> note;
  ExternalToolResult* tool = nullptr;  // null for flagstone's own candidates
};

std::vector<CloudView> views_of(std::span<const io::Cloud> scans) {
  std::vector<CloudView> views;
  for (const io::Cloud& scan : scans) views.push_back(scan.view());
  return views;
}

std::vector<std::size_t> sizes_of(std::span<const io::Cloud> scans) {
  std::vector<std::size_t> sizes;
  for (const io::Cloud& scan : scans) sizes.push_back(scan.size());
  return sizes;
}

class Benchmark {
 public:
  Benchmark(std::span<const io::Cloud> scans, const BenchmarkSettings& settings,
            const BenchmarkWatch& watch)
      : scans_(scans),
        settings_(settings),
        watch_(watch),
        target_reset_(settings.target),
        views_(views_of(scans)),
        results_(method_name(settings.config), sizes_of(scans)) {
    results_.target = simd_target();
    results_.threads = settings.threads;
    if (settings.threads == 1) {
      pinned_ = std::make_unique<PinnedCore>();
      results_.core = pinned_->core();
    }
    enter_ours();
    if (settings.external_tools) enter_external_tools(*settings.external_tools);
  }

  Results run() {
    const std::size_t rounds = warm_up();
    for (std::size_t round = 0; round < rounds && !watch_.stop(); ++round) {
      // Progress is reported only in rounds with external tools; in between, the remaining time is
      // unknown.
      if (has_external_tools(round)) watch_.progress(round, rounds);
      results_.rounds = round + 1;
      run_round(round);
    }
    return std::move(results_);
  }

 private:
  void enter_ours() {
    auto segment = segmenter(results_.target, TimedSegment::Stages::not_timed);
    const TimedSegment* const timed = segment.get();
    enter(
        std::move(segment), [this, timed](std::size_t round, std::size_t scan, const Trial& trial) {
          add(results_.segment, round, scan, trial);
          if (results_.allocations) {
            results_.allocations = std::max(results_.allocations.value_or(0), timed->allocations());
          }
        });
    enter(std::make_unique<TimedReadBaseline>(views_, results_.target),
          [this](auto round, auto scan, const Trial& trial) {
            add(results_.floor, round, scan, trial);
          });
    enter(segmenter("scalar", TimedSegment::Stages::not_timed),
          [this](auto round, auto scan, const Trial& trial) {
            add(results_.scalar, round, scan, trial);
          });
    enter(segmenter(results_.target, TimedSegment::Stages::timed),
          [this](std::size_t round, std::size_t scan, const Trial& trial) {
            for (StageResult& stage : results_.stages) {
              const double seconds = trial.stages[static_cast<std::size_t>(stage.stage)];
              stage.times.add(round, scan, 1000 * seconds);
            }
          });
    ours_ = entrants_.size();
  }

  /// Makes a segmenter and warms it up on every scan. For the first one, also measures the
  /// allocated memory.
  std::unique_ptr<TimedSegment> segmenter(const std::string& target, TimedSegment::Stages stages) {
    const std::size_t held_before = allocation_count().bytes;
    auto made = std::make_unique<TimedSegment>(views_, settings_.config, settings_.mount,
                                               settings_.threads, target, stages);
    for (std::size_t scan = 0; scan < scans_.size() && !watch_.stop(); ++scan)
      made->run_trial(scan);
    if (!results_.bytes_held && allocations_are_counted()) {
      results_.bytes_held = allocation_count().bytes - held_before;
      results_.allocations = 0;
    }
    return made;
  }

  void enter_external_tools(const ExternalToolPaths& places) {
    const auto known = known_external_tools(places, sensor_height(settings_.config));
    results_.external_tools.reserve(known.size());  // because of pointers to its elements
    for (const ExternalToolCommand& command : known) {
      results_.external_tools.push_back({command.name, Measured(scans_.size()), command.missing});
      ExternalToolResult& result = results_.external_tools.back();
      if (!command.missing.empty() || watch_.stop()) continue;
      try {
        auto tool = std::make_unique<ExternalTool>(command);
        tool->take(scans_);
        enter(std::move(tool), [&result](auto round, auto scan, const Trial& trial) {
          add(result.measured, round, scan, trial);
        });
        entrants_.back().tool = &result;
      } catch (const ExternalToolError& error) {
        result.left_out = error.what();
      }
    }
  }

  template <class Note>
  void enter(std::unique_ptr<Candidate> candidate, Note note) {
    entrants_.push_back({std::move(candidate), std::move(note)});
  }

  static void add(Measured& measured, std::size_t round, std::size_t scan, const Trial& trial) {
    measured.times.add(round, scan, trial.milliseconds);
    measured.ground[scan] = trial.ground;
  }

  /// Runs all candidates on all scans and returns the number of rounds.
  std::size_t warm_up() {
    const auto seconds_of = [&](std::size_t begin, std::size_t end) {
      Stopwatch stopwatch;
      for (std::size_t i = begin; i < end; ++i) try_all(entrants_[i], std::nullopt);
      return stopwatch.lap() / 1000;
    };
    seconds_of(0, ours_);
    const double own = seconds_of(0, ours_);
    const double tools = seconds_of(ours_, entrants_.size());
    drop_failed();
    if (own <= 0) return 0;  // interrupted
    // With this ratio, both groups take about the same time.
    rounds_per_tool_round_ = static_cast<std::size_t>(std::clamp(tools / own, 1.0, 1e6));
    if (settings_.rounds != 0) return settings_.rounds;
    const double each = own + tools / static_cast<double>(rounds_per_tool_round_);
    return static_cast<std::size_t>(
        std::clamp(seconds_by_default / each, fewest_rounds, most_rounds));
  }

  /// Whether external tools take part in this round. Without external tools, this is true for every
  /// round.
  [[nodiscard]] bool has_external_tools(std::size_t round) const {
    return round % rounds_per_tool_round_ == 0;
  }

  void run_round(std::size_t round) {
    const bool with_tools = has_external_tools(round);
    // Rounds with and without external tools are numbered separately, so that each kind uses every
    // order.
    const std::size_t tool_rounds = round / rounds_per_tool_round_;
    const std::size_t turn = with_tools ? tool_rounds : round - tool_rounds - 1;
    for (const std::size_t i : order_of_round(with_tools ? entrants_.size() : ours_, turn)) {
      try_all(entrants_[i], round);
    }
    drop_failed();
  }

  /// Runs the passes of a candidate over all scans. Times are recorded only if `round` is set. If
  /// an external tool fails, its result contains the reason.
  void try_all(Entrant& entrant, std::optional<std::size_t> round) {
    try {
      const auto note = [&](std::size_t scan, const Trial& trial) {
        if (round) entrant.note(*round, scan, trial);
      };
      run_passes(*entrant.candidate, scans_.size(), note, watch_.stop);
    } catch (const ExternalToolError& error) {
      if (!watch_.stop()) entrant.tool->left_out = error.what();
      entrant.candidate = nullptr;
    }
  }

  void drop_failed() {
    std::erase_if(entrants_, [](const Entrant& entrant) { return entrant.candidate == nullptr; });
  }

  std::span<const io::Cloud> scans_;
  const BenchmarkSettings& settings_;
  const BenchmarkWatch& watch_;
  TargetReset target_reset_;
  std::vector<CloudView> views_;
  Results results_;
  std::unique_ptr<PinnedCore> pinned_;
  std::vector<Entrant> entrants_;  // flagstone's own, then external tools
  std::size_t ours_ = 0;
  std::size_t rounds_per_tool_round_ = 1;
};

}  // namespace

Results run_benchmark(std::span<const io::Cloud> scans, const BenchmarkSettings& settings,
                      const BenchmarkWatch& watch) {
  return Benchmark(scans, settings, watch).run();
}

double ground_share(const Results& results, const Measured& measured) {
  std::size_t points = 0;
  std::size_t ground = 0;
  for (std::size_t scan = 0; scan < results.points.size(); ++scan) {
    const std::optional<std::size_t>& found = measured.ground[scan];
    if (!found) continue;
    points += results.points[scan];
    ground += *found;
  }
  return static_cast<double>(ground) / static_cast<double>(points);
}

}  // namespace flagstone::bench

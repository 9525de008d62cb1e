// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace flagstone::eval {
namespace {

Spread over_scans(const std::vector<ScanScore>& scans,
                  double (Confusion::*share)() const noexcept) {
  std::vector<double> values;
  values.reserve(scans.size());
  for (const ScanScore& scan : scans) values.push_back((scan.score.points.*share)());
  return spread_of(values);
}

void summarize_speed(MethodResult& result) {
  std::vector<double> times;
  for (const ScanScore& scan : result.scans) {
    if (scan.segment_ms) times.push_back(*scan.segment_ms);
  }
  if (times.empty()) return;
  constexpr double second = 1000;
  result.hz = second / spread_of(times).mean;
  result.hz_slowest_1_percent = second / mean_of_slowest_percent(times);
}

/// `errors_of` selects a range band of a HeightScore.
template <class ErrorsOf>
HeightFigures height_figures(const std::vector<ScanScore>& scans, ErrorsOf errors_of) {
  HeightErrors pooled;
  std::vector<double> medians;
  std::vector<double> percentiles;
  std::vector<double> biases;
  for (const ScanScore& scan : scans) {
    if (!scan.heights) continue;
    const HeightErrors& errors = errors_of(*scan.heights);
    pooled.points += errors.points;
    pooled.given += errors.given;
    if (errors.given == 0) continue;
    medians.push_back(errors.median);
    percentiles.push_back(errors.percentile95);
    biases.push_back(errors.bias);
  }
  return {.points = pooled.points,
          .share = pooled.share(),
          .median = spread_of(medians),
          .percentile95 = spread_of(percentiles),
          .bias = spread_of(biases)};
}

HeightFiguresByRange height_figures_by_range(const std::vector<ScanScore>& scans,
                                             HeightErrorsByRange HeightScore::* points) {
  HeightFiguresByRange figures;
  figures.all = height_figures(
      scans, [&](const HeightScore& s) -> const HeightErrors& { return (s.*points).all; });
  for (std::size_t band = 0; band < figures.by_range.size(); ++band) {
    figures.by_range[band] = height_figures(
        scans,
        [&](const HeightScore& s) -> const HeightErrors& { return (s.*points).by_range[band]; });
  }
  return figures;
}

void summarize_heights(MethodResult& result) {
  const auto has = [](const ScanScore& scan) { return scan.heights.has_value(); };
  if (std::ranges::none_of(result.scans, has)) return;
  result.heights = {.ground = height_figures_by_range(result.scans, &HeightScore::ground),
                    .everywhere = height_figures_by_range(result.scans, &HeightScore::everywhere),
                    .common_ground = {},
                    .common_everywhere = {}};
  const auto has_common = [](const ScanScore& scan) {
    return scan.heights && scan.heights->has_common;
  };
  if (std::ranges::none_of(result.scans, has_common)) return;
  HeightResult& heights = *result.heights;
  heights.has_common = true;
  heights.common_ground = height_figures_by_range(result.scans, &HeightScore::common_ground);
  heights.common_everywhere =
      height_figures_by_range(result.scans, &HeightScore::common_everywhere);
}

void summarize(MethodResult& result) {
  result.precision = over_scans(result.scans, &Confusion::precision);
  result.recall = over_scans(result.scans, &Confusion::recall);
  result.f1 = over_scans(result.scans, &Confusion::f1);
  result.accuracy = over_scans(result.scans, &Confusion::accuracy);
  result.iou = over_scans(result.scans, &Confusion::iou);
  for (const ScanScore& scan : result.scans) {
    result.pooled += scan.score.points;
    result.by_area += scan.score.by_area;
    for (std::size_t band = 0; band < result.by_range.size(); ++band) {
      result.by_range[band] += scan.score.by_range[band];
    }
  }
  summarize_heights(result);
  summarize_speed(result);
}

/// `counts_of` selects a range band of a MovingScore.
template <class CountsOf>
MovingFigures moving_figures(const std::vector<MovingScanScore>& scans, CountsOf counts_of) {
  MovingFigures figures;
  std::vector<double> ious;
  for (const MovingScanScore& scan : scans) {
    const MovingCounts& counts = counts_of(scan.score);
    figures.pooled += counts;
    ious.push_back(counts.points.iou());  // NaN without moving points
  }
  figures.iou = spread_of(ious);
  return figures;
}

void summarize(MovingResult& result) {
  result.all = moving_figures(result.scans,
                              [](const MovingScore& s) -> const MovingCounts& { return s.all; });
  for (std::size_t band = 0; band < result.by_range.size(); ++band) {
    result.by_range[band] = moving_figures(
        result.scans,
        [band](const MovingScore& s) -> const MovingCounts& { return s.by_range[band]; });
  }
}

/// Whether a point is scored. All methods are scored on the same points.
bool is_scored(const ScanOutcome& outcome) {
  return outcome.methods.empty() ||
         std::ranges::any_of(outcome.methods, [](const MethodOutcome& made) {
           return made.error || made.score.points.total() > 0;
         });
}

/// Whether the scan has a score but no ground in the ground truth.
bool has_no_ground(const ScanOutcome& outcome) {
  const auto scored = std::ranges::find_if_not(
      outcome.methods, [](const MethodOutcome& made) { return made.error.has_value(); });
  return scored != outcome.methods.end() && !scored->score.points.has_ground();
}

void add_moving(const LabelledScan& scan, const ScanOutcome& outcome, Results& results) {
  for (std::size_t m = 0; m < results.moving.size(); ++m) {
    const MovingOutcome& made = outcome.moving[m];
    if (made.error) {
      results.failures.push_back({scan.name, *made.error});
    } else {
      results.moving[m].scans.push_back({scan.name, made.score});
    }
  }
}

void add(const LabelledScan& scan, const ScanOutcome& outcome, Results& results) {
  if (outcome.error) {
    results.failures.push_back({scan.name, *outcome.error});
    return;
  }
  add_moving(scan, outcome, results);
  if (!is_scored(outcome)) {
    results.unscored.push_back(scan.name);
    return;
  }
  ++results.scans;
  if (has_no_ground(outcome)) ++results.without_ground;
  results.time.read += outcome.read_ms;
  results.time.score += outcome.score_ms;
  for (std::size_t m = 0; m < results.methods.size(); ++m) {
    const MethodOutcome& made = outcome.methods[m];
    if (made.error) {
      results.failures.push_back({scan.name, *made.error});
      continue;
    }
    results.methods[m].scans.push_back({scan.name, made.score, made.segment_ms, made.heights});
    results.time.segment += made.segment_ms.value_or(0);
  }
}

}  // namespace

bool has_heights(const Results& results) {
  return std::ranges::any_of(results.methods,
                             [](const MethodResult& m) { return m.heights.has_value(); });
}

bool has_common_heights(const Results& results) {
  return std::ranges::any_of(results.methods, [](const MethodResult& method) {
    return method.heights && method.heights->has_common;
  });
}

Results gather(std::span<const Method> methods, std::span<const LabelledScan> scans,
               std::span<const std::optional<ScanOutcome>> outcomes,
               std::span<const MovingSource> moving) {
  Results results;
  for (const Method& method : methods) {
    MethodResult& result = results.methods.emplace_back();
    result.name = method.name;
    result.title = method.title;
  }
  for (const MovingSource& source : moving) {
    results.moving.push_back({.name = source.name, .scans = {}, .all = {}});
  }
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::optional<ScanOutcome>& outcome = outcomes[i];
    if (outcome) add(scans[i], *outcome, results);
  }
  for (MethodResult& result : results.methods) summarize(result);
  for (MovingResult& result : results.moving) summarize(result);
  return results;
}

std::vector<std::size_t> worst_scans(const MethodResult& result, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    if (result.scans[i].score.points.has_ground()) order.push_back(i);
  }
  std::ranges::sort(order, {},
                    [&](std::size_t i) { return std::pair(result.scans[i].score.points.f1(), i); });
  order.resize(std::min(count, order.size()));
  return order;
}

}  // namespace flagstone::eval

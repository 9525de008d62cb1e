// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "files/io/message.hpp"

namespace flagstone::eval {
namespace {

constexpr double percent = 100;

/// A number in a column of `width`. The best number of a column is bold or marked with an asterisk.
std::string cell(double value, int width, int digits, bool is_best, const TextStyle& style) {
  if (!is_best) return fmt::format("{:>{}.{}f} ", value, width, digits);
  if (style.bold) return fmt::format("\x1b[1m{:>{}.{}f}\x1b[0m ", value, width, digits);
  return fmt::format("{:>{}.{}f}*", value, width, digits);
}

std::string optional_cell(const std::optional<double>& value, int width, int digits,
                          bool is_best = false, const TextStyle& style = {}) {
  if (!value) return fmt::format("{:>{}} ", "-", width);
  if (std::isnan(*value)) return fmt::format("{:>{}} ", "n/a", width);
  return cell(*value, width, digits, is_best, style);
}

/// Rounds a value as it is printed, so that values that look equal count as equally good.
double printed(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

using Value = std::function<std::optional<double>(const MethodResult&)>;

struct Column {
  std::string_view heading;
  int width;
  int digits;
  Value value;
  bool small_is_good = false;
  bool has_best = true;
};

/// Only methods that succeeded on every scan are compared.
bool is_complete(const Results& results, const MethodResult& result) {
  return result.scans.size() == results.scans && results.scans > 0;
}

/// The best value of a column, as printed: the largest or the smallest. None for a single method.
std::optional<double> best_of(const Results& results, const Column& column) {
  std::optional<double> best;
  if (!column.has_best || results.methods.size() < 2) return best;
  for (const MethodResult& result : results.methods) {
    const std::optional<double> own = column.value(result);
    if (!own || std::isnan(*own) || !is_complete(results, result)) continue;
    const double value = printed(*own, column.digits);
    if (!best || (column.small_is_good ? value < *best : value > *best)) best = value;
  }
  return best;
}

std::optional<double> in_percent(const std::optional<double>& share) {
  return share ? std::optional(percent * *share) : std::nullopt;
}

/// Lists the methods that were scored on fewer scans than the table.
std::string footnotes(const Results& results) {
  std::string text;
  for (const MethodResult& result : results.methods) {
    if (is_complete(results, result)) continue;
    text += fmt::format("{}: scored on {} of {} scans\n", io::printable(result.title),
                        result.scans.size(), results.scans);
  }
  return text;
}

std::string table(const Results& results, const std::vector<Column>& columns,
                  const TextStyle& style) {
  std::size_t name_width = 6;
  for (const MethodResult& result : results.methods) {
    name_width = std::max(name_width, result.title.size());
  }
  std::string text = fmt::format("{:<{}}", "Method", name_width);
  for (const Column& column : columns) text += fmt::format("{:>{}} ", column.heading, column.width);
  text += '\n';
  std::vector<std::optional<double>> best(columns.size());
  std::ranges::transform(columns, best.begin(), [&](const auto& c) { return best_of(results, c); });
  for (const MethodResult& result : results.methods) {
    text += fmt::format("{:<{}}", io::printable(result.title), name_width);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Column& column = columns[c];
      const std::optional<double> value =
          result.scans.empty() ? std::nullopt : column.value(result);
      const bool is_best = value && best[c] && is_complete(results, result) &&
                           printed(*value, column.digits) == best[c].value_or(0);
      text += optional_cell(value, column.width, column.digits, is_best, style);
    }
    text += '\n';
  }
  return text + footnotes(results);
}

/// Hz of the paper's Table II, on an Intel Core i7-7700K, sequence 05 of SemanticKITTI.
std::optional<double> hz_in_the_paper(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 5> table = {{{"line_fit", 58.96},
                                                                         {"cascaded", 13.07},
                                                                         {"gpf", 29.72},
                                                                         {"r_gpf", 35.30},
                                                                         {"patchwork", 43.97}}};
  const auto* const row = std::ranges::find(table, name, [](const auto& r) { return r.first; });
  return row == table.end() ? std::nullopt : std::optional(row->second);
}

}  // namespace

std::string accuracy_table(const Results& results, const TextStyle& style) {
  const std::vector<Column> columns = {
      {"precision", 11, 2, [](const auto& r) { return in_percent(r.precision.mean); }},
      {"std", 6, 2, [](const auto& r) { return in_percent(r.precision.std); }, true},
      {"recall", 9, 2, [](const auto& r) { return in_percent(r.recall.mean); }},
      {"std", 6, 2, [](const auto& r) { return in_percent(r.recall.std); }, true},
      {"F1", 9, 2, [](const auto& r) { return in_percent(r.f1.mean); }},
      {"±95%", 6, 2, [](const auto& r) { return in_percent(r.f1.ci95); }, false, false},
      {"accuracy", 10, 2, [](const auto& r) { return in_percent(r.accuracy.mean); }},
      {"IoU", 8, 2, [](const auto& r) { return in_percent(r.iou.mean); }},
      {"F1/cell", 9, 2, [](const auto& r) { return in_percent(r.by_area.f1()); }},
      {"Hz", 9, 1, [](const auto& r) { return r.hz; }},
  };
  std::string text = table(results, columns, style);
  if (results.without_ground > 0) {
    text += fmt::format(
        "{} of {} scans have no ground in the ground truth: only accuracy and Hz include them\n",
        results.without_ground, results.scans);
  }
  return text;
}

std::string range_table(const Results& results, const TextStyle& style) {
  std::vector<std::string> headings;
  float from = 0;
  for (const float to : range_bands) {
    headings.push_back(fmt::format("{}-{} m", from, to));
    from = to;
  }
  const auto f1 = [](const Confusion& points) { return in_percent(points.f1()); };
  std::vector<Column> columns = {
      {"all", 10, 2, [f1](const MethodResult& r) { return f1(r.pooled); }}};
  columns.reserve(headings.size() + 1);
  for (std::size_t band = 0; band < headings.size(); ++band) {
    columns.push_back({headings[band], 10, 2,
                       [f1, band](const MethodResult& r) { return f1(r.by_range[band]); }});
  }
  return table(results, columns, style);
}

std::string height_table(const Results& results, HeightFiguresByRange HeightResult::* points,
                         const TextStyle& style) {
  Results judged = results;
  std::erase_if(judged.methods, [](const MethodResult& method) { return !method.heights; });
  constexpr double centimetres = 100;
  std::vector<std::string> headings;
  float from = 0;
  for (const float to : height_bands) {
    headings.push_back(fmt::format("{}-{} m", from, to));
    from = to;
  }
  std::vector<Column> columns;
  for (std::size_t band = 0; band < headings.size(); ++band) {
    const auto add = [&](std::string_view heading, int width, auto value, bool small_is_good,
                         bool has_best) {
      const auto of_method = [points, band, value](const MethodResult& r) -> std::optional<double> {
        return r.heights ? value(((*r.heights).*points).by_range[band]) : std::nullopt;
      };
      columns.push_back({heading, width, 2, of_method, small_is_good, has_best});
    };
    const auto mean_of = [](Spread HeightFigures::* figure) {
      return [figure](const HeightFigures& figures) -> std::optional<double> {
        const Spread& spread = figures.*figure;
        return spread.count == 0 ? std::nullopt : std::optional(centimetres * spread.mean);
      };
    };
    add(headings[band], 11, mean_of(&HeightFigures::median), true, true);
    add("95 %", 7, mean_of(&HeightFigures::percentile95), true, true);
    add("bias", 7, mean_of(&HeightFigures::bias), true, false);
    add("coverage", 9, [](const auto& figures) { return in_percent(figures.share); }, false, true);
  }
  return table(judged, columns, style);
}

std::string moving_table(const Results& results) {
  std::size_t name_width = 6;
  for (const MovingResult& result : results.moving) {
    name_width = std::max(name_width, result.name.size());
  }
  std::string text = fmt::format("{:<{}}{:>10}{:>9}{:>9}{:>11}{:>9}{:>11}{:>8}{:>15}\n", "Moving",
                                 name_width, "range", "IoU", "recall", "precision", "kept",
                                 "mean IoU", "±95%", "moving points");
  const auto row = [&](const std::string& name, const std::string& band,
                       const MovingFigures& figures) {
    const Confusion& points = figures.pooled.points;
    text += fmt::format(
        "{:<{}}{:>10}{:>9}{:>9}{:>11}{:>9}{:>11}{:>8}{:>15}\n", name, name_width, band,
        percent_text(points.iou()), percent_text(points.recall()), percent_text(points.precision()),
        percent_text(figures.pooled.kept_share()), percent_text(figures.iou.mean),
        figures.iou.ci95 ? percent_text(*figures.iou.ci95) : "-", figures.pooled.moving());
  };
  for (const MovingResult& result : results.moving) {
    const std::string name = io::printable(result.name);
    float from = 0;
    for (std::size_t band = 0; band < range_bands.size(); ++band) {
      row(name, fmt::format("{}-{} m", from, range_bands[band]), result.by_range[band]);
      from = range_bands[band];
    }
    row(name, "all", result.all);
    if (result.scans.size() < results.scans) {
      text +=
          fmt::format("{}: scored on {} of {} scans\n", name, result.scans.size(), results.scans);
    }
  }
  return text;
}

std::string worst_table(const Results& results, std::size_t count) {
  std::string text;
  for (const MethodResult& result : results.methods) {
    text += fmt::format("{:<15}", io::printable(result.title));
    for (const std::size_t i : worst_scans(result, count)) {
      const ScanScore& scan = result.scans[i];
      text +=
          fmt::format("  {} ({})", io::printable(scan.scan), percent_text(scan.score.points.f1()));
    }
    text += '\n';
  }
  return text;
}

std::string speed_table(const Results& results) {
  const std::vector<Column> columns = {
      {"mean", 10, 1, [](const auto& r) { return r.hz; }, false, false},
      {"slowest 1%", 12, 1, [](const auto& r) { return r.hz_slowest_1_percent; }, false, false},
      {"paper", 10, 2, [](const auto& r) { return hz_in_the_paper(r.name); }, false, false},
  };
  return table(results, columns, {});
}

std::string time_shares(const Results& results) {
  const TimeSpent& time = results.time;
  const double all = time.read + time.segment + time.score;
  if (all <= 0) return "";
  return fmt::format(
      "time: reading {:.0f} %, segmenting {:.0f} %, scoring {:.0f} % of {:.1f} s "
      "(sum of {} threads)\n",
      percent * time.read / all, percent * time.segment / all, percent * time.score / all,
      all / 1000, results.threads);
}

}  // namespace flagstone::eval

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/results_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string_view>

namespace flagstone::eval {
namespace {

constexpr double percent = 100;

/// A number in a column of `width`; the best of its column stands out.
std::string cell(double value, int width, int digits, bool is_best, const TextStyle& style) {
  if (!is_best) return fmt::format("{:>{}.{}f} ", value, width, digits);
  if (style.bold) return fmt::format("\x1b[1m{:>{}.{}f}\x1b[0m ", value, width, digits);
  return fmt::format("{:>{}.{}f}*", value, width, digits);
}

std::string optional_cell(const std::optional<double>& value, int width, int digits,
                          bool is_best = false, const TextStyle& style = {}) {
  if (!value) return fmt::format("{:>{}} ", "-", width);
  return cell(*value, width, digits, is_best, style);
}

/// The value itself as it is printed, so that what looks the same is equally good.
double printed(double value, int digits) {
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

using Value = std::function<std::optional<double>(const MethodResult&)>;

/// The best value of a column: the largest, or the smallest.
std::optional<double> best_of(const Results& results, const Value& value, int digits,
                              bool small_is_good) {
  std::optional<double> best;
  for (const MethodResult& result : results.methods) {
    const std::optional<double> own = value(result);
    if (!own || result.scans.empty()) continue;
    const double rounded = printed(*own, digits);
    if (!best || (small_is_good ? rounded < *best : rounded > *best)) best = rounded;
  }
  return best;
}

struct Column {
  std::string_view heading;
  int width;
  int digits;
  Value value;
  bool small_is_good = false;
  bool has_best = true;
};

std::optional<double> in_percent(const std::optional<double>& share) {
  return share ? std::optional(percent * *share) : std::nullopt;
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
  std::vector<std::optional<double>> best;
  for (const Column& column : columns) {
    best.push_back(column.has_best
                       ? best_of(results, column.value, column.digits, column.small_is_good)
                       : std::nullopt);
  }
  for (const MethodResult& result : results.methods) {
    text += fmt::format("{:<{}}", result.title, name_width);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Column& column = columns[c];
      const std::optional<double> value =
          result.scans.empty() ? std::nullopt : column.value(result);
      const bool is_best = value && best[c] && printed(*value, column.digits) == *best[c] &&
                           results.methods.size() > 1;
      text += optional_cell(value, column.width, column.digits, is_best, style);
    }
    text += '\n';
  }
  return text;
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
      {"F1/area", 9, 2, [](const auto& r) { return in_percent(r.by_area.f1()); }},
      {"Hz", 9, 1, [](const auto& r) { return r.hz; }},
  };
  return table(results, columns, style);
}

std::string range_table(const Results& results, const TextStyle& style) {
  std::vector<std::string> headings;
  float from = 0;
  for (const float to : range_bands) {
    headings.push_back(fmt::format("{}-{} m", from, to));
    from = to;
  }
  std::vector<Column> columns;
  for (std::size_t band = 0; band < range_bands.size(); ++band) {
    columns.push_back({headings[band], 10, 2, [band](const MethodResult& r) {
                         return in_percent(r.by_range[band].f1());
                       }});
  }
  return table(results, columns, style);
}

std::string worst_table(const Results& results, std::size_t count) {
  std::string text;
  for (const MethodResult& result : results.methods) {
    text += fmt::format("{:<15}", result.title);
    for (const std::size_t i : worst_scans(result, count)) {
      const ScanScore& scan = result.scans[i];
      text += fmt::format("  {} ({:.2f})", scan.scan, percent * scan.score.points.f1());
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
      "over {} threads\n",
      percent * time.read / all, percent * time.segment / all, percent * time.score / all,
      all / 1000, results.threads);
}

}  // namespace flagstone::eval

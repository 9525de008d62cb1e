// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/sweep_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lab/report/embedded_files.hpp"
#include "lab/report/html.hpp"
#include "lab/report/page.hpp"

namespace flagstone::report {
namespace {

using Json = nlohmann::ordered_json;

bool is_number(const std::string& text) noexcept {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stopped == end;
}

/// The cells of a sweep, arranged on a grid by the values of one or two keys.
class SweepGrid {
 public:
  /// `results` has the format of sweep_report() and must outlive this object. Throws
  /// std::invalid_argument if there are not one or two keys, or if a cell has a different number of
  /// values.
  explicit SweepGrid(const Json& results);

  [[nodiscard]] const std::vector<std::string>& keys() const noexcept { return keys_; }

  /// The values of a key in order of first appearance.
  [[nodiscard]] const std::vector<std::string>& values(std::size_t key) const {
    return values_.at(key);
  }

  /// Whether all values of a key are numbers.
  [[nodiscard]] bool is_numeric(std::size_t key) const;

  /// Mean and standard deviation of a metric for value `first` of the first key and value `second`
  /// of the second key (0 if there is one key). Null if the sweep has no such cell.
  [[nodiscard]] Json mean(std::size_t first, std::size_t second, const char* metric) const;
  [[nodiscard]] Json deviation(std::size_t first, std::size_t second, const char* metric) const;

  /// Lowest and highest mean of a metric; 0 and 0 if there is no mean.
  [[nodiscard]] std::pair<double, double> bounds(const char* metric) const;

 private:
  [[nodiscard]] Json number(std::size_t first, std::size_t second, const char* metric,
                            const char* of) const;

  std::vector<std::string> keys_;
  std::vector<std::vector<std::string>> values_;  // per key
  std::map<std::vector<std::string>, const Json*> cells_;
};

SweepGrid::SweepGrid(const Json& results)
    : keys_(results.at("keys").get<std::vector<std::string>>()), values_(keys_.size()) {
  if (keys_.empty() || keys_.size() > 2)
    throw std::invalid_argument("a sweep must have one or two keys");
  for (const Json& cell : results.at("cells")) {
    auto values = cell.at("values").get<std::vector<std::string>>();
    if (values.size() != keys_.size())
      throw std::invalid_argument("a cell of a sweep must have one value per key");
    for (std::size_t key = 0; key < values.size(); ++key)
      if (std::ranges::find(values_[key], values[key]) == values_[key].end())
        values_[key].push_back(values[key]);
    cells_.emplace(std::move(values), &cell);
  }
}

bool SweepGrid::is_numeric(std::size_t key) const {
  return std::ranges::all_of(values_.at(key), is_number);
}

Json SweepGrid::mean(std::size_t first, std::size_t second, const char* metric) const {
  return number(first, second, metric, "mean");
}

Json SweepGrid::deviation(std::size_t first, std::size_t second, const char* metric) const {
  return number(first, second, metric, "std");
}

std::pair<double, double> SweepGrid::bounds(const char* metric) const {
  std::vector<double> means;
  for (const auto& [values, cell] : cells_)
    if (const Json& mean = cell->at(metric).at("mean"); mean.is_number())
      means.push_back(mean.get<double>());
  if (means.empty()) return {0, 0};
  const auto [low, high] = std::ranges::minmax(means);
  return {low, high};
}

Json SweepGrid::number(std::size_t first, std::size_t second, const char* metric,
                       const char* of) const {
  std::vector<std::string> values = {values_[0].at(first)};
  if (keys_.size() > 1) values.push_back(values_[1].at(second));
  const auto cell = cells_.find(values);
  return cell == cells_.end() ? Json() : cell->second->at(metric).at(of);
}

struct Metric {
  const char* name;
  const char* title;
};
constexpr std::array<Metric, 3> metrics = {{
    {.name = "f1", .title = "F1"},
    {.name = "precision", .title = "Precision"},
    {.name = "recall", .title = "Recall"},
}};

std::string all_settings(const Json& results) {
  using enum Format;
  std::vector<Column> columns;
  const Json& keys = results.at("keys");
  columns.reserve(keys.size() + 3 * metrics.size());
  for (std::size_t key = 0; key < keys.size(); ++key)
    columns.push_back(
        {"", keys[key].get<std::string>(), fmt::format("/values/{}", key), text, false});
  for (const auto& [name, title] : metrics) {
    const std::string group = fmt::format("{}, %", title);
    columns.push_back({group, "mean", fmt::format("/{}/mean", name), percent, true});
    columns.push_back({group, "σ", fmt::format("/{}/std", name), percent, false});
    columns.push_back({group, "± 95 %", fmt::format("/{}/ci95", name), percent, false});
  }
  return table(results.at("cells"), columns);
}

std::string canvases() {
  std::string html =
      "<section>\n<h2>Plots</h2>\n<noscript><p>The plots need JavaScript; the table contains the "
      "same numbers.</p></noscript>\n<div class=\"plots\">\n";
  for (const auto& [name, title] : metrics)
    html += fmt::format(
        "<div class=\"plot\"><h3>{1}</h3><p>Mean and standard deviation over the scans, %</p>\n"
        "<div class=\"canvas\"><canvas id=\"{0}\" role=\"img\" aria-label=\"{1} of each setting\">"
        "</canvas></div></div>\n",
        name, title);
  return html + "</div>\n</section>\n";
}

// The shade increases linearly from 0 for the lowest mean to 1 for the highest.
std::string heat_table(const SweepGrid& grid, const Metric& metric) {
  const auto [low, high] = grid.bounds(metric.name);
  std::string html = fmt::format(
      "<h3>{}, %</h3>\n<div class=\"scroll\"><table class=\"heat\">\n<thead><tr>"
      "<th class=\"name\">{} ↓ &nbsp; {} →</th>",
      metric.title, escaped(grid.keys()[0]), escaped(grid.keys()[1]));
  for (const std::string& second : grid.values(1))
    html += fmt::format("<th scope=\"col\">{}</th>", escaped(second));
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t row = 0; row < grid.values(0).size(); ++row) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", escaped(grid.values(0)[row]));
    for (std::size_t column = 0; column < grid.values(1).size(); ++column) {
      const Json mean = grid.mean(row, column, metric.name);
      const double shade =
          mean.is_number() && high > low ? (mean.get<double>() - low) / (high - low) : 0;
      html += fmt::format("<td style=\"--shade: {:.3f}\">{}</td>", shade, percent_text(mean));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string heat_tables(const SweepGrid& grid) {
  std::string html =
      "<section>\n<h2>Means of all settings</h2>\n<p class=\"note\">Darker cells have a higher "
      "mean.</p>\n";
  for (const Metric& metric : metrics) html += heat_table(grid, metric);
  return html + "</section>\n";
}

Json plot_data(const SweepGrid& grid) {
  Json series = Json::array();
  const std::size_t lines = grid.keys().size() > 1 ? grid.values(1).size() : 1;
  for (std::size_t line = 0; line < lines; ++line) {
    Json points;
    for (const auto& [name, title] : metrics) {
      points[name] = Json::array();
      for (std::size_t value = 0; value < grid.values(0).size(); ++value)
        points[name].push_back(
            {{"mean", grid.mean(value, line, name)}, {"std", grid.deviation(value, line, name)}});
    }
    series.push_back(points);
  }
  Json values = Json::array();
  for (std::size_t key = 0; key < grid.keys().size(); ++key) values.push_back(grid.values(key));
  return {{"keys", grid.keys()}, {"values", values}, {"series", series}};
}

}  // namespace

std::string sweep_report(const Json& results) {
  const SweepGrid grid(results);
  constexpr std::size_t most_lines = 6;
  const bool heat = grid.keys().size() == 2 && grid.values(1).size() > most_lines &&
                    grid.is_numeric(0) && grid.is_numeric(1);
  const std::string title =
      fmt::format("Sweep of {} for {} on {} ({}), protocol {}", fmt::join(grid.keys(), " and "),
                  results.at("method").get<std::string>(), dataset_names(results),
                  scan_count(results), results.at("protocol").get<std::string>());
  const std::string heading = escaped(title);
  const std::string fact_list = facts(results);
  const std::string winner = escaped(results.at("winner").get<std::string>());
  const std::string plots = heat ? heat_tables(grid) : canvases();
  const std::string settings = all_settings(results);
  const std::array slots = {
      Slot{"heading", heading}, Slot{"facts", fact_list}, Slot{"winner", winner},
      Slot{"plots", plots},     Slot{"table", settings},
  };
  return page(title, fill(embedded::sweep_html, slots), heat ? Json::object() : plot_data(grid),
              embedded::sweep_js);
}

}  // namespace flagstone::report

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sweep_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <utility>

#include "lab/eval/results_export.hpp"

namespace flagstone::cli {
namespace {

constexpr double percent = 100;

std::string name_of(const Sweep& sweep, std::size_t point) {
  const std::vector<std::string> values = sweep.values_at(point);
  std::string name;
  for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
    name += fmt::format("{}{} = {}", a == 0 ? "" : ", ", sweep.axes[a].key, values[a]);
  }
  return name;
}

/// A column that holds the axis's key and every value, apart from the one before.
std::size_t width_of(const SweepAxis& axis) {
  std::size_t longest = axis.key.size();
  for (const std::string& value : axis.values) longest = std::max(longest, value.size());
  return longest + 2;
}

/// A dash where one scan allows no figure.
std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:>6}", eval::percent_text(*share)) : fmt::format("{:>6}", "-");
}

std::string spread_text(const eval::Spread& spread) {
  return fmt::format("{:>8} {}", eval::percent_text(spread.mean), percent_text(spread.std));
}

/// F1 of `a` less that of `b` on the scans that both have.
eval::Spread difference(const eval::MethodResult& a, const eval::MethodResult& b) {
  std::map<std::string, double> of_b;
  for (const eval::ScanScore& scan : b.scans) of_b[scan.scan] = scan.score.points.f1();
  std::vector<double> differences;
  for (const eval::ScanScore& scan : a.scans) {
    const auto found = of_b.find(scan.scan);
    if (found != of_b.end()) differences.push_back(scan.score.points.f1() - found->second);
  }
  return eval::spread_of(differences);
}

}  // namespace

std::vector<std::string> Sweep::values_at(std::size_t point) const {
  std::vector<std::string> values(axes.size());
  for (std::size_t a = axes.size(); a-- > 0;) {
    values[a] = axes[a].values[point % axes[a].values.size()];
    point /= axes[a].values.size();
  }
  return values;
}

std::string to_text(const Sweep& sweep) {
  std::string text;
  for (const SweepAxis& axis : sweep.axes) text += fmt::format("{:>{}}", axis.key, width_of(axis));
  text += fmt::format("{:>11}{:>7}{:>9}{:>7}{:>9}{:>7}{:>7}\n", "precision", "std", "recall", "std",
                      "F1", "std", "±95%");
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    const std::vector<std::string> values = sweep.values_at(p);
    for (std::size_t a = 0; a < values.size(); ++a) {
      text += fmt::format("{:>{}}", values[a], width_of(sweep.axes[a]));
    }
    text +=
        fmt::format("   {} {} {} {}\n", spread_text(result.precision), spread_text(result.recall),
                    spread_text(result.f1), percent_text(result.f1.ci95));
  }
  return text;
}

std::string to_csv(const Sweep& sweep) {
  std::string text;
  for (const SweepAxis& axis : sweep.axes) text += eval::csv_cell(axis.key) + ",";
  text += "scans";
  for (const char* figure : {"precision", "recall", "f1"}) {
    text += fmt::format(",{0}_mean,{0}_std,{0}_ci95", figure);
  }
  text += "\r\n";
  const auto cell = [](const std::optional<double>& value) {
    return value && !std::isnan(*value) ? fmt::format(",{:.6f}", *value) : std::string(",");
  };
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    for (const std::string& value : sweep.values_at(p)) text += eval::csv_cell(value) + ",";
    text += fmt::format("{}", result.scans.size());
    for (const eval::Spread& spread : {result.precision, result.recall, result.f1}) {
      text += cell(spread.mean) + cell(spread.std) + cell(spread.ci95);
    }
    text += "\r\n";
  }
  return text;
}

nlohmann::ordered_json to_json(const Sweep& sweep) {
  nlohmann::ordered_json json = eval::results_heading();
  json["protocol"] = sweep.results.protocol;
  json["datasets"] = sweep.results.datasets;
  json["scans"] = sweep.results.scans;
  json["method"] = sweep.method;
  json["keys"] = nlohmann::ordered_json::array();
  for (const SweepAxis& axis : sweep.axes) json["keys"].push_back(axis.key);
  json["cells"] = nlohmann::ordered_json::array();
  for (std::size_t p = 0; p < sweep.results.methods.size(); ++p) {
    const eval::MethodResult& result = sweep.results.methods[p];
    json["cells"].push_back({{"values", sweep.values_at(p)},
                             {"precision", eval::to_json(result.precision)},
                             {"recall", eval::to_json(result.recall)},
                             {"f1", eval::to_json(result.f1)}});
  }
  json["winner"] = winner_text(sweep);
  return json;
}

std::string winner_text(const Sweep& sweep) {
  const std::vector<eval::MethodResult>& points = sweep.results.methods;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (sweep.results.scans == sweep.results.without_ground) {
    return "No scan has ground in its ground truth: there is no F1.";
  }
  std::erase_if(order, [&](std::size_t p) { return points[p].f1.count == 0; });  // it failed
  if (order.empty()) return "No setting has an F1.";
  std::ranges::sort(order, {}, [&](std::size_t p) { return std::pair(-points[p].f1.mean, p); });
  std::string text = fmt::format("Best F1: {:.2f} % at {}", percent * points[order[0]].f1.mean,
                                 name_of(sweep, order[0]));
  if (order.size() < 2) return text + ".";
  const eval::Spread ahead = difference(points[order[0]], points[order[1]]);
  text +=
      fmt::format("; {:.2f} points ahead of {}", percent * ahead.mean, name_of(sweep, order[1]));
  if (!ahead.ci95) return text + "; one scan gives no interval.";
  if (*ahead.ci95 == 0) return text + ", the same on every scan.";
  const double intervals = ahead.mean / *ahead.ci95;
  return text + fmt::format(", {:.1f} times the 95 % interval of the difference: {}.", intervals,
                            intervals > 1 ? "more than noise" : "no more than noise");
}

}  // namespace flagstone::cli

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "lab/eval/method.hpp"
#include "lab/eval/results_export.hpp"

namespace flagstone::bench {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json times_json(const SampleTimes& times) {
  return {{"median_ms", times.median()}, {"p99_ms", times.percentile_99()}};
}

Json segment_json(const Results& results, const Measured& measured) {
  Json json = times_json(measured.times);
  json["points_per_second"] = measured.times.points_per_second(results.points);
  json["ground"] = ground_share(results, measured);
  return json;
}

Json stages_json(const Results& results) {
  Json json = Json::object();
  for (const StageResult& stage : results.stages) {
    Json& entry = json[to_string(stage.stage)];
    entry = times_json(stage.times);
    entry["ratio"] = stage.times.ratio_to(results.floor.times);
  }
  return json;
}

Json external_tools_json(const Results& results) {
  Json json = Json::object();
  for (const ExternalToolResult& tool : results.external_tools) {
    Json& entry = json[tool.name];
    if (!tool.left_out.empty()) entry["left_out"] = tool.left_out;
    if (tool.measured.times.count() == 0) continue;
    entry.update(segment_json(results, tool.measured));
    entry["ratio"] = tool.measured.times.ratio_to(results.segment.times);
    entry["samples"] = tool.measured.times.count();
  }
  return json;
}

}  // namespace

Json to_json(const Results& results) {
  Json json;
  json["method"] = results.method;
  json["segment"] = segment_json(results, results.segment);
  json["floor"] = times_json(results.floor.times);
  json["ratio_to_floor"] = results.segment.times.ratio_to(results.floor.times);
  json["scalar"] = segment_json(results, results.scalar);
  json["ratio_to_scalar"] = results.segment.times.ratio_to(results.scalar.times);
  json["stages"] = stages_json(results);
  json["external_tools"] = external_tools_json(results);
  json["target"] = results.target;
  json["allocations"] = or_null(results.allocations);
  json["bytes_held"] = or_null(results.bytes_held);
  json["points"] = results.points;
  json["rounds"] = results.rounds;
  json["threads"] = results.threads;
  json["core"] = or_null(results.core);
  json["machine"] = eval::machine_name();
  json["date"] = eval::today();
  return json;
}

namespace {

/// A number in a column; "-" if it is not finite.
std::string cell(double value, int width, int digits) {
  if (!std::isfinite(value)) return fmt::format("{:>{}}", "-", width);
  return fmt::format("{:>{}.{}f}", value, width, digits);
}

/// "1 scan", "2 scans".
std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

double mean_points(const Results& results) {
  const auto sum = std::accumulate(results.points.begin(), results.points.end(), std::size_t{0});
  return static_cast<double>(sum) / static_cast<double>(results.points.size());
}

std::string heading(const Results& results) {
  const std::string place =
      results.core ? fmt::format("pinned to core {}", *results.core) : "not pinned to a core";
  return fmt::format(
      "{} with {}, {}; {} of {:.0f} points (mean) in rotation, {} after warm-up\n"
      "{}, {}; {}\n",
      method_title(results.method), results.target, counted(results.threads, "thread"),
      counted(results.points.size(), "scan"), mean_points(results),
      counted(results.rounds, "round"), eval::machine_name(), place, eval::today());
}

std::string row(const Results& results, std::string_view name, const Measured& measured,
                bool finds_ground = true) {
  const SampleTimes& times = measured.times;
  return fmt::format(
      "{:<27}{}{}{}{}{}{}{:>9}\n", name, cell(times.median(), 10, 3),
      cell(times.percentile_99(), 10, 3),
      cell(times.points_per_second(results.points) / 1e6, 12, 1),
      cell(times.ratio_to(results.floor.times), 12, 2),
      cell(times.ratio_to(results.segment.times), 11, 3),
      finds_ground ? cell(100 * ground_share(results, measured), 10, 2) : cell(NAN, 10, 2),
      times.count());
}

std::string candidates(const Results& results) {
  std::string text =
      fmt::format("{:<27}{:>10}{:>10}{:>12}{:>12}{:>11}{:>10}{:>9}\n", "", "median ms", "p99 ms",
                  "Mpoints/s", "x baseline", "x segment", "ground %", "samples");
  text += row(results, "segment", results.segment);
  text += row(results, "read-only baseline", results.floor, false);
  text += row(results, "segment, scalar build", results.scalar);
  for (const ExternalToolResult& tool : results.external_tools) {
    if (tool.measured.times.count() > 0) text += row(results, tool.name, tool.measured);
  }
  return text;
}

std::string stages(const Results& results) {
  double sum = 0;
  for (const StageResult& stage : results.stages) sum += stage.times.median();
  std::string text = fmt::format("{:<27}{:>10}{:>10}{:>12}{:>12}{:>11}\n", "stage", "median µs",
                                 "p99 µs", "ns/point", "x baseline", "time %");
  for (const StageResult& stage : results.stages) {
    const SampleTimes& times = stage.times;
    text += fmt::format(
        "{:<27}{}{}{}{}{}\n", to_string(stage.stage), cell(1000 * times.median(), 10, 1),
        cell(1000 * times.percentile_99(), 10, 1),
        cell(1e6 * times.median() / mean_points(results), 12, 3),
        cell(times.ratio_to(results.floor.times), 12, 2), cell(100 * times.median() / sum, 11, 1));
  }
  return text + fmt::format("{:<27}{}\n", "sum of the medians", cell(1000 * sum, 10, 1));
}

std::string memory(const Results& results) {
  if (!results.allocations || !results.bytes_held) {
    return "allocations and memory: not counted in this program\n";
  }
  const auto held = static_cast<double>(*results.bytes_held);
  return fmt::format(
      "maximum allocations per scan after warm-up: {}\n"
      "memory of segmenter and result: {:.1f} bytes per point of the largest scan ({:.2f} MB)\n",
      *results.allocations, held / static_cast<double>(std::ranges::max(results.points)),
      held / 1e6);
}

std::string left_out(const Results& results) {
  std::string text;
  for (const ExternalToolResult& tool : results.external_tools) {
    if (!tool.left_out.empty()) text += fmt::format("{} excluded: {}\n", tool.name, tool.left_out);
  }
  return text;
}

}  // namespace

std::string to_text(const Results& results) {
  return fmt::format("{}\n{}\n{}\n{}{}", heading(results), candidates(results), stages(results),
                     memory(results), left_out(results));
}

}  // namespace flagstone::bench

// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results_export.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>

#include "flagstone/version.hpp"

namespace flagstone::eval {
std::string machine_name() {
  std::string name = "unknown CPU";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      name = line.substr(colon + 2);
      break;
    }
  }
  return fmt::format("{}, {} cores", name, std::thread::hardware_concurrency());
}

std::string today() {
  return fmt::format("{:%Y-%m-%d}",
                     std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
}

namespace {

/// Headings of the height errors at a set of points.
std::string height_headings(std::string_view prefix) {
  std::string text;
  float from = 0;
  for (const float to : height_bands) {
    for (const char* figure : {"median", "percentile95", "bias", "share"}) {
      text += fmt::format(",{}_{}_{}_{}m", prefix, figure, from, to);
    }
    from = to;
  }
  return text;
}

std::string heading(bool with_heights, bool with_common_heights) {
  std::string text = "method,scan,precision,recall,f1,accuracy,iou,tp,fp,fn,tn";
  float from = 0;
  for (const float to : range_bands) {
    text += fmt::format(",f1_{}_{}m", from, to);
    from = to;
  }
  text += ",f1_by_area,milliseconds";
  if (with_heights) text += height_headings("height");
  if (with_common_heights) text += height_headings("height_common");
  return text + "\r\n";
}

/// Cells of the height errors over ground points, metres; empty without heights.
std::string height_cells(const HeightErrors& errors) {
  const std::optional<double> share = errors.share();
  const std::string share_cell = share ? fmt::format(",{:.6f}", *share) : ",";
  if (errors.given == 0) return ",,," + share_cell;
  return fmt::format(",{:.6f},{:.6f},{:.6f}", errors.median, errors.percentile95, errors.bias) +
         share_cell;
}

/// A ratio; empty if it is undefined.
std::string ratio_cell(double ratio) {
  return std::isnan(ratio) ? "," : fmt::format(",{:.6f}", ratio);
}

std::string row(const MethodResult& result, const ScanScore& scan, bool with_heights,
                bool with_common_heights) {
  const Confusion& all = scan.score.points;
  std::string text = csv_cell(result.name) + "," + csv_cell(scan.scan);
  for (const double ratio : {all.precision(), all.recall(), all.f1(), all.accuracy(), all.iou()}) {
    text += ratio_cell(ratio);
  }
  text += fmt::format(",{},{},{},{}", all.true_positives, all.false_positives, all.false_negatives,
                      all.true_negatives);
  for (const Confusion& band : scan.score.by_range) text += ratio_cell(band.f1());
  text += ratio_cell(scan.score.by_area.f1()) + ",";
  if (scan.segment_ms) text += fmt::format("{:.4f}", *scan.segment_ms);
  const HeightScore heights = scan.heights.value_or(HeightScore());
  if (with_heights) {
    for (const HeightErrors& band : heights.ground.by_range) text += height_cells(band);
  }
  if (with_common_heights) {
    for (const HeightErrors& band : heights.common_ground.by_range) text += height_cells(band);
  }
  return text + "\r\n";
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string to_csv(const Results& results) {
  const bool with_heights = has_heights(results);
  const bool with_common_heights = has_common_heights(results);
  std::string text = heading(with_heights, with_common_heights);
  for (const MethodResult& result : results.methods) {
    for (const ScanScore& scan : result.scans) {
      text += row(result, scan, with_heights, with_common_heights);
    }
  }
  return text;
}

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson or_null(double value) { return std::isnan(value) ? OrderedJson() : OrderedJson(value); }
OrderedJson or_null(const std::optional<double>& value) {
  return value ? or_null(*value) : OrderedJson();
}

OrderedJson shares(const Confusion& confusion) {
  return {{"precision", or_null(confusion.precision())},
          {"recall", or_null(confusion.recall())},
          {"f1", or_null(confusion.f1())},
          {"accuracy", or_null(confusion.accuracy())},
          {"iou", or_null(confusion.iou())}};
}

OrderedJson by_range(const MethodResult& result) {
  OrderedJson bands = OrderedJson::array();
  float from = 0;
  for (std::size_t band = 0; band < range_bands.size(); ++band) {
    OrderedJson entry = {{"from", from}, {"to", range_bands[band]}};
    entry.update(shares(result.by_range[band]));
    entry["points"] = result.by_range[band].total();
    bands.push_back(std::move(entry));
    from = range_bands[band];
  }
  return bands;
}

OrderedJson to_json(const HeightFigures& figures) {
  OrderedJson json = {{"points", figures.points}, {"with_height", or_null(figures.share)}};
  json["median"] = to_json(figures.median);
  json["percentile95"] = to_json(figures.percentile95);
  json["bias"] = to_json(figures.bias);
  return json;
}

/// Height errors of one scan.
OrderedJson to_json(const HeightErrors& errors) {
  const auto if_any = [&](double figure) {
    return errors.given > 0 ? OrderedJson(figure) : OrderedJson();
  };
  return {{"points", errors.points},
          {"with_height", or_null(errors.share())},
          {"median", if_any(errors.median)},
          {"percentile95", if_any(errors.percentile95)},
          {"bias", if_any(errors.bias)}};
}

/// `heights` is a HeightFiguresByRange, or the HeightErrorsByRange of one scan.
template <class ByRange>
OrderedJson heights_by_range(const ByRange& heights) {
  OrderedJson json = to_json(heights.all);
  json["by_range"] = OrderedJson::array();
  float from = 0;
  for (std::size_t band = 0; band < height_bands.size(); ++band) {
    OrderedJson entry = {{"from", from}, {"to", height_bands[band]}};
    entry.update(to_json(heights.by_range[band]));
    json["by_range"].push_back(std::move(entry));
    from = height_bands[band];
  }
  return json;
}

/// `heights` is a HeightResult, or the HeightScore of one scan.
template <class Heights>
OrderedJson heights_json(const Heights& heights) {
  OrderedJson json = {{"ground", heights_by_range(heights.ground)},
                      {"everywhere", heights_by_range(heights.everywhere)}};
  if (heights.has_common) {
    json["common_ground"] = heights_by_range(heights.common_ground);
    json["common_everywhere"] = heights_by_range(heights.common_everywhere);
  }
  return json;
}

OrderedJson per_scan(const MethodResult& result) {
  OrderedJson scans = OrderedJson::array();
  for (const ScanScore& scan : result.scans) {
    OrderedJson entry = {{"scan", scan.scan}};
    entry.update(shares(scan.score.points));
    entry["milliseconds"] = or_null(scan.segment_ms);
    if (scan.heights) entry["heights"] = heights_json(*scan.heights);
    scans.push_back(std::move(entry));
  }
  return scans;
}

OrderedJson to_json(const MethodResult& result) {
  OrderedJson json = {{"name", result.name}, {"title", result.title}};
  json["scans"] = result.scans.size();
  json["precision"] = to_json(result.precision);
  json["recall"] = to_json(result.recall);
  json["f1"] = to_json(result.f1);
  json["accuracy"] = to_json(result.accuracy);
  json["iou"] = to_json(result.iou);
  json["pooled"] = shares(result.pooled);
  json["pooled"]["points"] = result.pooled.total();
  json["by_range"] = by_range(result);
  json["by_area"] = shares(result.by_area);
  json["by_area"]["cells"] = result.by_area.total();
  if (result.heights) json["heights"] = heights_json(*result.heights);
  json["hz"] = or_null(result.hz);
  json["hz_slowest_1_percent"] = or_null(result.hz_slowest_1_percent);
  json["worst"] = OrderedJson::array();
  constexpr std::size_t worst_count = 5;
  for (const std::size_t i : worst_scans(result, worst_count)) {
    json["worst"].push_back(result.scans[i].scan);
  }
  json["per_scan"] = per_scan(result);
  return json;
}

OrderedJson to_json(const MovingCounts& counts) {
  return {{"iou", or_null(counts.points.iou())},
          {"recall", or_null(counts.points.recall())},
          {"precision", or_null(counts.points.precision())},
          {"kept", or_null(counts.kept_share())},
          {"points", counts.points.total()},
          {"moving_points", counts.moving()},
          {"marked_points", counts.marked()}};
}

OrderedJson to_json(const MovingFigures& figures) {
  OrderedJson json = to_json(figures.pooled);
  json["mean_iou"] = to_json(figures.iou);
  return json;
}

OrderedJson to_json(const MovingResult& result) {
  OrderedJson json = {{"name", result.name}, {"scans", result.scans.size()}};
  json.update(to_json(result.all));
  json["by_range"] = OrderedJson::array();
  float from = 0;
  for (std::size_t band = 0; band < range_bands.size(); ++band) {
    OrderedJson entry = {{"from", from}, {"to", range_bands[band]}};
    entry.update(to_json(result.by_range[band]));
    json["by_range"].push_back(std::move(entry));
    from = range_bands[band];
  }
  json["per_scan"] = OrderedJson::array();
  for (const MovingScanScore& scan : result.scans) {
    OrderedJson entry = {{"scan", scan.scan}};
    entry.update(to_json(scan.score.all));
    json["per_scan"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"mean", or_null(spread.mean)},
          {"std", or_null(spread.std)},
          {"ci95", or_null(spread.ci95)},
          {"scans", spread.count}};
}

nlohmann::ordered_json results_heading() {
  return {{"flagstone", FLAGSTONE_VERSION}, {"date", today()}, {"machine", machine_name()}};
}

nlohmann::ordered_json to_json(const Results& results) {
  OrderedJson json = results_heading();
  json["threads"] = results.threads;
  json["protocol"] = results.protocol;
  json["datasets"] = results.datasets;
  json["scans"] = results.scans;
  json["without_ground"] = results.without_ground;
  json["unscored"] = results.unscored;
  json["failed"] = OrderedJson::array();
  for (const Failure& failure : results.failures) {
    json["failed"].push_back({{"scan", failure.scan}, {"error", failure.error}});
  }
  json["milliseconds"] = {{"read", results.time.read},
                          {"segment", results.time.segment},
                          {"score", results.time.score}};
  json["methods"] = OrderedJson::array();
  for (const MethodResult& result : results.methods) json["methods"].push_back(to_json(result));
  for (const MovingResult& result : results.moving) json["moving"].push_back(to_json(result));
  return json;
}

}  // namespace flagstone::eval

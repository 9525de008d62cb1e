// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results_json.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "flagstone/version.hpp"
#include "lab/eval/machine.hpp"

namespace flagstone::eval {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json shares(const Confusion& confusion) {
  return {{"precision", confusion.precision()},
          {"recall", confusion.recall()},
          {"f1", confusion.f1()},
          {"accuracy", confusion.accuracy()},
          {"iou", confusion.iou()}};
}

/// Those of points pooled over scans: null where there are none.
Json pooled_shares(const Confusion& confusion) {
  Json json = shares(confusion);
  if (confusion.total() == 0) {
    for (Json& share : json) share = nullptr;
  }
  return json;
}

/// A figure over the scans of a method: null where there are none.
Json figure(const MethodResult& result, const Spread& spread) {
  Json json = to_json(spread);
  if (result.scans.empty()) json["mean"] = nullptr;
  return json;
}

Json by_range(const MethodResult& result) {
  Json bands = Json::array();
  float from = 0;
  for (std::size_t band = 0; band < range_bands.size(); ++band) {
    Json entry = {{"from", from}, {"to", range_bands[band]}};
    entry.update(pooled_shares(result.by_range[band]));
    entry["points"] = result.by_range[band].total();
    bands.push_back(std::move(entry));
    from = range_bands[band];
  }
  return bands;
}

Json to_json(const HeightFigures& figures) {
  Json json = {{"points", figures.points}, {"with_height", or_null(figures.share)}};
  json["median"] = to_json(figures.median);
  json["percentile95"] = to_json(figures.percentile95);
  json["bias"] = to_json(figures.bias);
  if (figures.scans == 0) {
    for (const char* figure : {"median", "percentile95", "bias"}) json[figure]["mean"] = nullptr;
  }
  return json;
}

/// A scan's own.
Json to_json(const HeightErrors& errors) {
  const auto if_any = [&](double figure) { return errors.given > 0 ? Json(figure) : Json(); };
  return {{"points", errors.points},
          {"with_height", or_null(errors.share())},
          {"median", if_any(errors.median)},
          {"percentile95", if_any(errors.percentile95)},
          {"bias", if_any(errors.bias)}};
}

/// HeightFiguresByRange, or a scan's HeightErrorsByRange.
template <class ByRange>
Json heights_by_range(const ByRange& heights) {
  Json json = to_json(heights.all);
  json["by_range"] = Json::array();
  float from = 0;
  for (std::size_t band = 0; band < height_bands.size(); ++band) {
    Json entry = {{"from", from}, {"to", height_bands[band]}};
    entry.update(to_json(heights.by_range[band]));
    json["by_range"].push_back(std::move(entry));
    from = height_bands[band];
  }
  return json;
}

/// HeightResult, or a scan's HeightScore.
template <class Heights>
Json heights_json(const Heights& heights) {
  return {{"ground", heights_by_range(heights.ground)},
          {"everywhere", heights_by_range(heights.everywhere)}};
}

Json per_scan(const MethodResult& result) {
  Json scans = Json::array();
  for (const ScanScore& scan : result.scans) {
    Json entry = {{"scan", scan.scan}};
    entry.update(shares(scan.score.points));
    entry["milliseconds"] = or_null(scan.segment_ms);
    if (scan.heights) entry["heights"] = heights_json(*scan.heights);
    scans.push_back(std::move(entry));
  }
  return scans;
}

Json to_json(const MethodResult& result) {
  Json json = {{"name", result.name}, {"title", result.title}};
  json["scans"] = result.scans.size();
  json["precision"] = figure(result, result.precision);
  json["recall"] = figure(result, result.recall);
  json["f1"] = figure(result, result.f1);
  json["accuracy"] = figure(result, result.accuracy);
  json["iou"] = figure(result, result.iou);
  json["pooled"] = pooled_shares(result.pooled);
  json["pooled"]["points"] = result.pooled.total();
  json["by_range"] = by_range(result);
  json["by_area"] = pooled_shares(result.by_area);
  json["by_area"]["cells"] = result.by_area.total();
  if (result.heights) json["heights"] = heights_json(*result.heights);
  json["hz"] = or_null(result.hz);
  json["hz_slowest_1_percent"] = or_null(result.hz_slowest_1_percent);
  json["worst"] = Json::array();
  constexpr std::size_t worst_count = 5;
  for (const std::size_t i : worst_scans(result, worst_count)) {
    json["worst"].push_back(result.scans[i].scan);
  }
  json["per_scan"] = per_scan(result);
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"std", or_null(spread.std)}, {"ci95", or_null(spread.ci95)}};
}

nlohmann::ordered_json results_heading() {
  return {{"flagstone", FLAGSTONE_VERSION}, {"date", today()}, {"machine", machine_name()}};
}

nlohmann::ordered_json to_json(const Results& results) {
  Json json = results_heading();
  json["threads"] = results.threads;
  json["protocol"] = results.protocol;
  json["datasets"] = results.datasets;
  json["scans"] = results.scans;
  json["unscored"] = results.unscored;
  json["failed"] = Json::array();
  for (const Failure& failure : results.failures) {
    json["failed"].push_back({{"scan", failure.scan}, {"error", failure.error}});
  }
  json["milliseconds"] = {{"read", results.time.read},
                          {"segment", results.time.segment},
                          {"score", results.time.score}};
  json["methods"] = Json::array();
  for (const MethodResult& result : results.methods) json["methods"].push_back(to_json(result));
  return json;
}

}  // namespace flagstone::eval

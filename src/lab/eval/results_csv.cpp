// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results_csv.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace flagstone::eval {
namespace {

std::string heading(bool with_heights) {
  std::string text = "method,scan,precision,recall,f1,accuracy,iou,tp,fp,fn,tn";
  float from = 0;
  for (const float to : range_bands) {
    text += fmt::format(",f1_{}_{}m", from, to);
    from = to;
  }
  text += ",f1_by_area,milliseconds";
  if (!with_heights) return text + "\r\n";
  from = 0;
  for (const float to : height_bands) {
    for (const char* figure : {"median", "percentile95", "bias", "share"}) {
      text += fmt::format(",height_{}_{}_{}m", figure, from, to);
    }
    from = to;
  }
  return text + "\r\n";
}

/// Metres, over points of the ground; empty where there are none.
std::string height_cells(const HeightErrors& errors) {
  const std::optional<double> share = errors.share();
  const std::string share_cell = share ? fmt::format(",{:.6f}", *share) : ",";
  if (errors.given == 0) return ",,," + share_cell;
  return fmt::format(",{:.6f},{:.6f},{:.6f}", errors.median, errors.percentile95, errors.bias) +
         share_cell;
}

std::string row(const MethodResult& result, const ScanScore& scan, bool with_heights) {
  const Confusion& all = scan.score.points;
  std::string text = fmt::format(
      "{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{}", csv_cell(result.name),
      csv_cell(scan.scan), all.precision(), all.recall(), all.f1(), all.accuracy(), all.iou(),
      all.true_positives, all.false_positives, all.false_negatives, all.true_negatives);
  for (const Confusion& band : scan.score.by_range) text += fmt::format(",{:.6f}", band.f1());
  text += fmt::format(",{:.6f},", scan.score.by_area.f1());
  if (scan.segment_ms) text += fmt::format("{:.4f}", *scan.segment_ms);
  if (with_heights) {
    for (const HeightErrors& band : scan.heights.value_or(HeightScore()).ground.by_range) {
      text += height_cells(band);
    }
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
  std::string text = heading(with_heights);
  for (const MethodResult& result : results.methods) {
    for (const ScanScore& scan : result.scans) text += row(result, scan, with_heights);
  }
  return text;
}

}  // namespace flagstone::eval
